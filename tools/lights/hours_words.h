// Words, numbers and clocks of texts of hours. Each function takes what it reads off the front of a
// text in lower case, with the blanks before it, and leaves the text as it is where it reads none.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace nightcity::lights {

void skip_spaces(std::string_view& text);

bool take(std::string_view& text, std::string_view sign);

/// Takes one of the words where no other letter follows, and returns its number.
std::optional<int> take_word(std::string_view& text, std::initializer_list<std::string_view> words);

/// Takes at most so many digits; no blanks before them.
std::optional<int> take_digits(std::string_view& text, std::size_t most);

/// Takes the number of a day in its month, behind which no clock goes on ("24", not "17:00").
std::optional<int> take_day_of_month(std::string_view& text);

/// Returns the number of a month from January, 0.
std::optional<int> take_month(std::string_view& text);

/// Returns the number of a weekday from Monday, 0; 7 and 8 are holidays of the public and of
/// schools. Besides the words of the wiki it knows those that people write in English and German.
std::optional<int> take_weekday(std::string_view& text);

/// Parses a clock ("23:00", "7.05", "18h30", "6pm", "6:30 pm", "noon") as minutes after midnight,
/// to 48:00.
std::optional<int> take_clock(std::string_view& text);

/// Writes what people put around and between hours as the wiki does: "daily 6 pm to 11 pm", "18:00
/// bis 23:00 Uhr", a remark in quotes, and, behind bars, what holds at other times.
std::string to_plain_hours(std::string text);

}  // namespace nightcity::lights
