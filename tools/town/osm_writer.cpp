#include "tools/town/osm_writer.h"

#include <cmath>
#include <string>

#include "tools/random.h"
#include "tools/town/approaches.h"
#include "tools/town/osm_elements.h"
#include "tools/town/osm_lamps.h"
#include "tools/town/roads.h"

namespace nightcity::town {
namespace {

constexpr std::int64_t first_way_id = 90000000, first_approach_id = 5000000000,
                       first_corner_id = 7000000000, first_area_id = 190000000;

class OsmWriter {
 public:
  OsmWriter(OsmElements& out, const StreetPlan& streets, const TownOptions& options)
      : out_(out), streets_(streets), options_(options) {}

  std::size_t write() {
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<osm version=\"0.6\" "
            "generator=\"nightbake town\">\n";
    for (int j = 0; j <= streets_.rows(); ++j)
      for (int i = 0; i <= streets_.columns(); ++i)
        out_.open_node(crossing_id(i, j), streets_.node(i, j)) << "/>\n";
    for_each_stretch(streets_, [&](const Stretch& s) {
      if (s.axis != 2) return;
      out_.open_node(path_node_id(s, 0), s.from) << "/>\n";
      out_.open_node(path_node_id(s, 1), s.to) << "/>\n";
    });
    for_each_stretch(streets_, [&](const Stretch& s) {
      for (const Approach& approach : find_approaches(streets_, s, options_.seed))
        write_approach(s, approach);
    });
    for_each_area([&](int i, int j, BlockUse) {
      const Quad corners = streets_.kerb(i, j);
      for (int k = 0; k < 4; ++k)
        out_.open_node(corner_id(i, j, k), corners[static_cast<std::size_t>(k)]) << "/>\n";
    });
    const std::size_t lamps = write_lamps(out_, streets_, options_);
    write_ways();
    for_each_area([&](int i, int j, BlockUse use) { write_area(i, j, use); });
    out_ << "</osm>\n";
    return lamps;
  }

 private:
  std::int64_t crossing_id(int i, int j) const {
    return 1000000000 + static_cast<std::int64_t>(j) * (streets_.columns() + 1) + i;
  }
  std::int64_t path_node_id(const Stretch& s, int end) const {
    return 2000000000 + 2 * (static_cast<std::int64_t>(s.j) * streets_.columns() + s.i) + end;
  }

  std::int64_t corner_id(int i, int j, int corner) const {
    return first_corner_id + (static_cast<std::int64_t>(j) * streets_.columns() + i) * 4 + corner;
  }

  std::int64_t approach_id(const Stretch& s, const Approach& approach) const {
    return first_approach_id +
           ((static_cast<std::int64_t>(s.axis) * (streets_.rows() + 1) + s.j) *
                (streets_.columns() + 1) +
            s.i) *
               max_approaches +
           approach.number;
  }

  void write_approach(const Stretch& s, const Approach& approach) {
    out_.open_node(approach_id(s, approach), approach.at) << ">\n";
    const char* direction = approach.at_end ? "forward" : "backward";
    switch (approach.kind) {
      case Approach::Kind::zebra:
        out_.tag("highway", "crossing");
        out_.tag("crossing", "zebra");
        break;
      case Approach::Kind::crossing_at_signals:
        out_.tag("highway", "crossing");
        out_.tag("crossing", "traffic_signals");
        out_.tag("crossing:markings", "zebra");
        break;
      case Approach::Kind::unmarked_crossing:
        out_.tag("highway", "crossing");
        out_.tag("crossing", "unmarked");
        out_.tag("kerb", "lowered");
        break;
      case Approach::Kind::signals:
        out_.tag("highway", "traffic_signals");
        out_.tag("traffic_signals:direction", direction);
        break;
      case Approach::Kind::give_way:
        out_.tag("highway", "give_way");
        out_.tag("direction", direction);
        break;
    }
    out_ << "</node>\n";
  }

  /// Visits the blocks whose ground is not that of gardens and yards, which maps say nothing of.
  template <class Visit>
  void for_each_area(const Visit& visit) const {
    for (int j = 0; j < streets_.rows(); ++j)
      for (int i = 0; i < streets_.columns(); ++i)
        if (const BlockUse use = streets_.use(i, j);
            use == BlockUse::market || use == BlockUse::park || use == BlockUse::slabs ||
            use == BlockUse::hall)
          visit(i, j, use);
  }

  /// An area reaches to the kerbs of its block: pavements lie over it.
  void write_area(int i, int j, BlockUse use) {
    out_ << "<way id=\"" << first_area_id + static_cast<std::int64_t>(j) * streets_.columns() + i
         << "\" version=\"1\">\n";
    for (const int k : {0, 1, 2, 3, 0}) out_ << "<nd ref=\"" << corner_id(i, j, k) << "\"/>\n";
    switch (use) {
      case BlockUse::market:
        out_.tag("highway", "pedestrian");
        out_.tag("area", "yes");
        out_.tag("name", "Market Square");
        out_.tag("surface", "paving_stones");
        break;
      case BlockUse::park:
        out_.tag("leisure", "park");
        break;
      case BlockUse::slabs:
        out_.tag("landuse", "grass");
        break;
      default:
        out_.tag("amenity", "parking");
        out_.tag("surface", "concrete");
        break;
    }
    out_ << "</way>\n";
  }

  void write_ways() {
    std::int64_t id = first_way_id;
    for (int j = 0; j <= streets_.rows(); ++j)
      write_runs(
          streets_.columns(), [&](int i) { return streets_.row_street(i, j); },
          [&](int i) { return crossing_id(i, j); }, 0, j, id);
    for (int i = 0; i <= streets_.columns(); ++i)
      write_runs(
          streets_.rows(), [&](int j) { return streets_.column_street(i, j); },
          [&](int j) { return crossing_id(i, j); }, 1, i, id);
    for_each_stretch(streets_, [&](const Stretch& s) {
      if (s.axis != 2) return;
      out_ << "<way id=\"" << id++ << "\" version=\"1\">\n<nd ref=\"" << path_node_id(s, 0)
           << "\"/>\n<nd ref=\"" << path_node_id(s, 1) << "\"/>\n";
      out_.tag("highway", "footway");
      out_.tag("lit", "yes");
      out_ << "</way>\n";
    });
  }

  /// Writes one way per run of equal class, at most eight blocks long. As in real extracts, names
  /// go on from way to way while other tags come and go.
  template <class ClassOf, class NodeOf>
  void write_runs(int count, ClassOf class_of, NodeOf node_of, int axis, int line,
                  std::int64_t& id) {
    for (int first = 0; first < count;) {
      int end = first + 1;
      while (end < count && end - first < 8 && class_of(end) == class_of(first)) ++end;
      out_ << "<way id=\"" << id++ << "\" version=\"1\">\n";
      for (int n = first; n <= end; ++n) {
        out_ << "<nd ref=\"" << node_of(n) << "\"/>\n";
        if (n == end) break;
        const Stretch s = find_stretch(streets_, axis == 0 ? n : line, axis == 0 ? line : n, axis);
        for (const Approach& approach : find_approaches(streets_, s, options_.seed))
          out_ << "<nd ref=\"" << approach_id(s, approach) << "\"/>\n";
      }
      tag_way(class_of(first), axis, line, first);
      out_ << "</way>\n";
      first = end;
    }
  }

  void tag_way(StreetClass street, int axis, int line, int first) {
    Random random{static_cast<std::int64_t>(options_.seed), 13, axis, line, first};
    out_.tag("highway", osm_name(street));
    out_.tag("name", (axis == 0 ? "Row Street " : "Column Street ") + std::to_string(line + 1));
    if (random.chance(0.4)) out_.tag("lit", random.chance(0.9) ? "yes" : "automatic");
    const StreetSize size = size_of(street);
    // A pedestrian street is paved from wall to wall.
    const bool driven = is_driven(street);
    const std::string metres = in_metres(size.carriageway_m + (driven ? 0 : 2 * size.pavement_m));
    out_.tag("width", random.chance(0.6) ? metres : metres + " m");
    if (driven) {
      out_.tag("sidewalk", "both");
      out_.tag("sidewalk:both:width", in_metres(size.pavement_m));
    }
    if (random.chance(0.2))
      out_.tag("lanes", size.carriageway_m > 10 ? "3" : size.carriageway_m > 5 ? "2" : "1");
    if (random.chance(0.35) && street != StreetClass::pedestrian) {
      constexpr const char* fast[] = {"50", "50 km/h", "30 mph", "DE:urban", "50;30"};
      constexpr const char* slow[] = {"30", "20 mph", "DE:zone:30", "walk", "30"};
      const bool main_road = street == StreetClass::primary || street == StreetClass::secondary;
      out_.tag("maxspeed", main_road ? fast[random.integer(0, 4)] : slow[random.integer(0, 4)]);
    }
    const bool one_way = street == StreetClass::residential && random.chance(0.25);
    if (one_way) out_.tag("oneway", random.chance(0.9) ? "yes" : "-1");
    tag_parking(street, one_way, random);
    if (random.chance(0.5)) out_.tag("surface", random.chance(0.7) ? "asphalt" : "sett");
  }

  /// Cars park where a carriageway has room for them beside its lanes, in the tags of both schemes.
  void tag_parking(StreetClass street, bool one_way, Random& random) {
    const bool has_room = street == StreetClass::secondary || street == StreetClass::tertiary ||
                          street == StreetClass::residential;
    if (!has_room || !random.chance(0.7)) return;
    const std::string side = random.chance(0.5) ? "left" : "right";
    if (street == StreetClass::residential && !one_way) {
      out_.tag("parking:" + side, "half_on_kerb");
      out_.tag("parking:" + side + ":orientation", "parallel");
    } else if (random.chance(0.7)) {
      out_.tag("parking:" + side, "lane");
      out_.tag("parking:" + side + ":orientation", "parallel");
      if (random.chance(0.7)) out_.tag("parking:" + side + ":markings", "yes");
    } else {
      out_.tag("parking:lane:" + side, "parallel");
    }
  }

  static std::string in_metres(double metres) {
    const auto decimetres = static_cast<int>(std::lround(metres * 10));
    return std::to_string(decimetres / 10) + "." + std::to_string(decimetres % 10);
  }

  OsmElements& out_;
  const StreetPlan& streets_;
  const TownOptions& options_;
};

}  // namespace

std::size_t write_osm(TextFile& out, const StreetPlan& streets, const TownOptions& options) {
  OsmElements elements(out, options);
  return OsmWriter(elements, streets, options).write();
}

}  // namespace nightcity::town
