#include "tools/lights/lamp_tag_words.h"

#include <array>
#include <utility>

namespace nightcity::lights {
namespace {

using std::string_view;

template <class Value, std::size_t N>
using Words = std::array<std::pair<string_view, Value>, N>;

template <class Value, std::size_t N>
std::optional<Value> look_up(string_view word, const Words<Value, N>& table) {
  for (const auto& [name, value] : table)
    if (word == name) return value;
  return std::nullopt;
}

constexpr Words<LampMount, 49> mounts = {{
    {"straight_mast", LampMount::straight_mast},
    {"mast", LampMount::straight_mast},
    {"straight", LampMount::straight_mast},
    {"pole", LampMount::straight_mast},
    {"power_pole", LampMount::bent_mast},
    {"utility_pole", LampMount::bent_mast},
    {"cast_steel_mast", LampMount::straight_mast},
    {"post", LampMount::straight_mast},
    {"high_mast", LampMount::straight_mast},
    {"column", LampMount::straight_mast},
    {"bent_mast", LampMount::bent_mast},
    {"bent", LampMount::bent_mast},
    {"angled_mast", LampMount::bent_mast},
    {"bend_mast", LampMount::bent_mast},
    {"curved_mast", LampMount::bent_mast},
    {"wall", LampMount::wall},
    {"wall_mounted", LampMount::wall},
    {"wall_mount", LampMount::wall},
    {"facade", LampMount::wall},
    {"ceiling", LampMount::wall},
    {"suspended", LampMount::suspended},
    {"wire", LampMount::suspended},
    {"wires", LampMount::suspended},
    {"catenary", LampMount::suspended},
    {"power_line", LampMount::suspended},
    {"ground", LampMount::bollard},
    {"bollard", LampMount::bollard},
    {"floor", LampMount::bollard},
    // OSM wiki, "Key:support", and other words of mappers: what a lamp hangs on.
    {"lamppost", LampMount::straight_mast},
    {"lamp_post", LampMount::straight_mast},
    {"street_lamp", LampMount::straight_mast},
    {"stand", LampMount::straight_mast},
    {"pedestal", LampMount::straight_mast},
    {"tower", LampMount::straight_mast},
    {"fence", LampMount::straight_mast},
    {"street_sign", LampMount::straight_mast},
    {"traffic_signals", LampMount::straight_mast},
    {"double_bent_mast", LampMount::bent_mast},
    {"wood_pole", LampMount::bent_mast},
    {"concrete_pole", LampMount::bent_mast},
    {"building", LampMount::wall},
    {"roof", LampMount::wall},
    {"awning", LampMount::wall},
    {"bracket", LampMount::wall},
    {"arm", LampMount::wall},
    {"billboard", LampMount::wall},
    {"bridge", LampMount::wall},
    {"tree", LampMount::suspended},
    {"arch", LampMount::suspended},
}};

using enum LampType;
constexpr Words<LampType, 102> types = {{
    {"led", led},
    {"leds", led},
    {"light_emitting_diode", led},
    {"high_pressure_sodium", high_pressure_sodium},
    {"sodium_high_pressure", high_pressure_sodium},
    {"sodium", high_pressure_sodium},  // nine in ten sodium street lamps
    {"sodium_vapor", high_pressure_sodium},
    {"sodium_vapour", high_pressure_sodium},
    {"son", high_pressure_sodium},
    {"hps", high_pressure_sodium},
    {"hpsv", high_pressure_sodium},
    {"low_pressure_sodium", low_pressure_sodium},
    {"sox", low_pressure_sodium},
    {"lps", low_pressure_sodium},
    {"mercury", mercury},
    {"mercury_vapor", mercury},
    {"mercury_vapour", mercury},
    {"high_pressure_mercury", mercury},
    {"metal_halide", metal_halide},
    {"metal_halogen", metal_halide},
    {"hqi", metal_halide},
    {"discharge", high_pressure_sodium},
    {"fluorescent", fluorescent},
    {"fluorescent_lamp", fluorescent},
    {"compact_fluorescent", fluorescent},
    {"neon", fluorescent},
    {"incandescent", incandescent},
    {"halogen", incandescent},
    {"gas", gas},
    {"gaslight", gas},
    {"gas_light", gas},
    {"gas_lamp", gas},
    {"high_pressure_sodium_vapor", high_pressure_sodium},
    {"high_pressure_sodium_vapour", high_pressure_sodium},
    {"sodium_lamp", high_pressure_sodium},
    {"low_pressure_sodium_vapor", low_pressure_sodium},
    {"low_pressure_sodium_vapour", low_pressure_sodium},
    {"mercury_lamp", mercury},
    {"high_pressure_mercury_vapor", mercury},
    {"high_pressure_mercury_vapour", mercury},
    {"metal_halide_lamp", metal_halide},
    {"ceramic_metal_halide", metal_halide},
    {"ceramic_discharge_metal_halide", metal_halide},
    {"fluorescent_tube", fluorescent},
    {"cfl", fluorescent},
    {"induction", fluorescent},
    {"tungsten", incandescent},
    {"tungsten_halogen", incandescent},
    // Codes of ILCOS (IEC 61231), of the German LBS and of makers.
    {"hs", high_pressure_sodium},
    {"hse", high_pressure_sodium},
    {"hst", high_pressure_sodium},
    {"nav", high_pressure_sodium},
    {"son_t", high_pressure_sodium},
    {"son_e", high_pressure_sodium},
    {"lst", low_pressure_sodium},
    {"lse", low_pressure_sodium},
    {"hme", mercury},
    {"hql", mercury},
    {"hpl", mercury},
    {"mh", metal_halide},
    {"mhl", metal_halide},
    {"hit", metal_halide},
    {"hie", metal_halide},
    {"hci", metal_halide},
    {"cdm", metal_halide},
    {"cdo", metal_halide},
    {"cpo", metal_halide},
    {"led_retrofit", led},
    {"natriumdampf", high_pressure_sodium},
    {"natrium", high_pressure_sodium},
    {"natriumlamp", high_pressure_sodium},
    {"natriumlampe", high_pressure_sodium},
    {"hogedruknatrium", high_pressure_sodium},
    {"vapor_de_sódio", high_pressure_sodium},
    {"vapor_de_sodio", high_pressure_sodium},
    {"vapor_de_sódio_de_alta_pressão", high_pressure_sodium},
    {"sódio", high_pressure_sodium},
    {"sodio", high_pressure_sodium},
    {"sodowa", high_pressure_sodium},
    {"sodowe", high_pressure_sodium},
    {"ナトリウム灯", high_pressure_sodium},
    {"高圧ナトリウムランプ", high_pressure_sodium},
    {"vapor_de_mercúrio", mercury},
    {"vapor_de_mercurio", mercury},
    {"mercúrio", mercury},
    {"mercurio", mercury},
    {"rtęciowa", mercury},
    {"rtęciowe", mercury},
    {"kwik", mercury},
    {"水銀灯", mercury},
    {"水銀ランプ", mercury},
    {"vapor_metálico", metal_halide},
    {"vapor_metalico", metal_halide},
    {"metalohalogenkowa", metal_halide},
    {"メタルハライドランプ", metal_halide},
    {"fluorescente", fluorescent},
    {"świetlówka", fluorescent},
    {"tl", fluorescent},
    {"蛍光灯", fluorescent},
    {"led灯", led},
    {"quecksilberdampf", mercury},
    {"leuchtstoff", fluorescent},
}};

// The usual market classes: warm 2700 to 3000 K, neutral 4000 K, cool 5000 to 6500 K.
constexpr Words<double, 20> colour_temperatures = {
    {{"warm_white", 2850},    {"warmwei\xc3\x9f", 2850},
     {"warmweiss", 2850},     {"neutralwei\xc3\x9f", 4000},
     {"neutralweiss", 4000},  {"kaltwei\xc3\x9f", 5500},
     {"kaltweiss", 5500},     {"warm", 2850},
     {"warmwhite", 2850},     {"warm_light", 2850},
     {"neutral_white", 4000}, {"neutral", 4000},
     {"white", 4000},         {"cool_white", 5500},
     {"cold_white", 5500},    {"cold", 5500},
     {"cool", 5500},          {"natural_white", 4000},
     {"day_light", 6500},     {"daylight", 6500}}};

}  // namespace

std::optional<LampMount> find_lamp_mount(string_view word) {
  return look_up(word, mounts);
}

// "sodium lamp", "lampa sodowa": the word for a lamp says nothing.
std::optional<LampType> find_lamp_type(string_view word) {
  if (const auto type = look_up(word, types)) return type;
  for (const string_view lamp : {"_lamp", "_lamps", "_lampe", "_light", "_bulb"})
    if (word.ends_with(lamp)) return look_up(word.substr(0, word.size() - lamp.size()), types);
  for (const string_view lamp :
       {"lampa_", "lampada_de_", "lâmpada_de_", "lámpara_de_", "lampara_de_"})
    if (word.starts_with(lamp)) return look_up(word.substr(lamp.size()), types);
  return std::nullopt;
}

std::optional<double> find_cct_k(string_view word) {
  return look_up(word, colour_temperatures);
}

}  // namespace nightcity::lights
