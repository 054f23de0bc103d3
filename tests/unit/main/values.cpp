// Values of options: rates of films.
#include "main/render/values.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "files/error.h"

namespace strahl {

TEST_CASE("decimals that stand for a rate of video are that rate") {
    for (const int whole : {12, 15, 24, 30, 48, 60, 72, 96, 120, 144, 240, 300}) {
        const double exact = whole * 1000 / 1001.;
        for (int digits = 2; digits < 10; ++digits) {
            char rounded[40];
            std::snprintf(rounded, sizeof rounded, "%.*f", digits, exact);
            const double unit = std::pow(10, digits);
            char cut[40];
            std::snprintf(cut, sizeof cut, "%.*f", digits, std::floor(exact * unit) / unit);
            for (const std::string text : {rounded, cut}) {
                CAPTURE(text);
                CHECK(parse_rate(text).text() == std::to_string(whole * 1000) + "/1001");
            }
        }
    }
    CHECK(parse_rate("29.97").moment(30000) == 1001);
}

TEST_CASE("other rates are the fraction that is written") {
    const auto is = [](const char* text, const char* fraction) {
        CAPTURE(text);
        CHECK(parse_rate(text).text() == fraction);
    };
    is("25", "25/1"), is("25.", "25/1"), is("25.00", "25/1"), is("12.5", "25/2"), is(".5", "1/2"),
        is("0.001", "1/1000");
    is("24000/1001", "24000/1001"), is("120000:1001", "120000/1001"), is("50/2", "25/1"), is("1000000", "1000000/1");
    // Rates that are not quite n/1001, or have too few digits to tell, are taken as they are written.
    is("59.9", "599/10"), is("59.95", "1199/20"), is("29.96", "749/25"), is("24.98", "1249/50"),
        is("23.977", "23977/1000");
    is("119.881", "119881/1000"), is("16.666667", "16666667/1000000");
}

TEST_CASE("values that are no rate are refused") {
    for (const char* text : {"",
                             ".",
                             "/",
                             "25/",
                             "/2",
                             "0",
                             "0/5",
                             "5/0",
                             "-25",
                             "1/-2",
                             "25/1/1",
                             "1e3",
                             "nan",
                             "inf",
                             "25 ",
                             "59,94",
                             "0.0009",
                             "1000000.1",
                             "1000001",
                             "1/1001",
                             "2147483648/1",
                             "99999999999999999999",
                             "16.66666666666667"}) {
        CAPTURE(text);
        CHECK_THROWS_WITH_AS(parse_rate(text), doctest::Contains("--fps"), UsageError);
    }
}

}  // namespace strahl
