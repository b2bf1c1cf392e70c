// Names of columns and files in the languages of open portals, and what they are taken for.
#include <gtest/gtest.h>

#include <string>

#include "support/temp_folder.h"
#include "tools/inventory/look_at_table.h"
#include "tools/inventory/read_inventory.h"

namespace nightcity::inventory {
namespace {

using test::TempFolder;

InventoryFile guess(const TempFolder& folder, const std::string& columns) {
  test::write_text(folder / "lamps.csv", "lon,lat," + columns + "\n13.4,52.5,8,40\n");
  return guess_inventory(folder / "lamps.csv", look_at_table(folder / "lamps.csv"));
}

TEST(LocalNames, HeightsAndWattsAreGuessedInManyLanguages) {
  const TempFolder folder;
  for (const char* columns :
       {"Höhe,Leistung", "hauteur,puissance", "ALTURA,POTENCIA", "altezza,potenza",
        "Lichtpunthoogte,vermogen", "höjd,effekt", "korkeus,teho", "wysokość,moc", "výška,příkon",
        "MOUNT_HT_FT,LAMP_WATTS", "height_m,power_w", "Lichtpunkthöhe [m],Leistung [W]"}) {
    const InventoryFile file = guess(folder, columns);
    const std::string names = columns;
    const std::size_t comma = names.find(',');
    EXPECT_EQ(file.columns.at("height"), names.substr(0, comma)) << columns;
    EXPECT_EQ(file.columns.at("watts"), names.substr(comma + 1)) << columns;
  }
  EXPECT_FALSE(guess(folder, "heightclass,powerful").columns.contains("height"));
}

TEST(LocalNames, PlacesAreFoundInManyLanguages) {
  const TempFolder folder;
  for (const char* names :
       {"X_RD,Y_RD", "itä,pohjoinen", "Est,Nord", "Este,Norte", "x_l93,y_l93"}) {
    test::write_text(folder / "lamps.csv", std::string("id,") + names + "\na,391020,5819010\n");
    InventoryFile file;
    file.file = folder / "lamps.csv";
    file.crs = "EPSG:25833";
    ASSERT_EQ(read_inventory(file).lamps.size(), 1u) << names;
  }
}

TEST(LocalNames, FilesAreToldForTablesOfLamps) {
  const TempFolder folder;
  const auto speaks = [&](const std::string& name) {
    test::write_text(folder / name, "id,lon,lat\na,13.4,52.5\n");
    return look_at_table(folder / name).speaks_of_lamps;
  };
  for (const char* name : {"alumbrado_publico.csv", "candelabros.csv", "valgustid.csv",
                           "kozvilagitas.csv", "Фонари освещения.csv", "街灯.csv"})
    EXPECT_TRUE(speaks(name)) << name;
  for (const char* name : {"traffic_lights.csv", "lichtsignalanlagen.csv", "flights.csv"})
    EXPECT_FALSE(speaks(name)) << name;
}

TEST(LocalNames, ATableMayEndInTxt) {
  const TempFolder folder;
  test::write_text(folder / "lamps.txt", "id;lon;lat\na;13,4;52,5\n");
  InventoryFile file;
  file.file = folder / "lamps.txt";
  file.crs = "EPSG:4326";
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 1u);
  EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5));
}

}  // namespace
}  // namespace nightcity::inventory
