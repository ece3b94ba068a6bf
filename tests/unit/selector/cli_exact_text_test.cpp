#include <gtest/gtest.h>

#include "runtime/error.h"
#include "selector/commands/exact_text.h"

namespace elastogen::selector {
namespace {

TEST(DecimalText, RoundsToSignificantDigits) {
  EXPECT_EQ(decimal_text(GiNaC::numeric(2, 3), 5), "0.66667");
  EXPECT_EQ(decimal_text(GiNaC::numeric(-1, 8), 3), "-0.125");
  EXPECT_EQ(decimal_text(GiNaC::numeric(999999, 1000), 4), "1000");
  EXPECT_EQ(decimal_text(GiNaC::numeric(12345), 3), "1.23e4");
  EXPECT_EQ(decimal_text(GiNaC::numeric(1, 30000000), 3), "3.33e-8");
  EXPECT_EQ(decimal_text(0, 4), "0.0000");
}

TEST(DecimalText, HasFortyRightDigitsOfARoot) {
  // 1/sqrt(3) = 0.57735026918962576450914878050195745564760175127...
  EXPECT_EQ(decimal_text(1 / GiNaC::sqrt(GiNaC::ex(3)), 40),
            "0.5773502691896257645091487805019574556476");
}

TEST(DecimalText, RefusesWhatIsNoNumber) {
  EXPECT_THROW((void)decimal_text(GiNaC::symbol("x"), 5), InternalError);
  EXPECT_THROW((void)decimal_text(GiNaC::I, 5), InternalError);
}

}  // namespace
}  // namespace elastogen::selector
