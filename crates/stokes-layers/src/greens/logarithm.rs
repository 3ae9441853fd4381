//! A natural logarithm that the compiler can vectorise.

const HALF_ROOT: u64 = 0x3FE6_A09E_667F_3BCD;
const ONE: u64 = 0x3FF0_0000_0000_0000;
const MANTISSA: u64 = 0x000F_FFFF_FFFF_FFFF;
const TWO_52: u64 = 0x4330_0000_0000_0000;
const LN2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Natural logarithm of a positive normal number to about 1e-16 of max(1, |ln x|); anything else gives a meaningless
/// number.
///
/// x = 2^e m with m between sqrt(1/2) and sqrt(2), and ln m = 2 artanh s with s = (m - 1)/(m + 1), |s| < 0.1716, by its
/// Taylor series. No branch and no table, so a loop over it runs in vector registers, which the library function's does
/// not.
#[inline(always)]
pub(crate) fn ln(x: f64) -> f64 {
    let shifted = x.to_bits().wrapping_add(ONE - HALF_ROOT);
    // The exponent becomes a float by being put into the low bits of 2^52.
    let exponent = f64::from_bits(TWO_52 | (shifted >> 52)) - (4_503_599_627_370_496.0 + 1023.0);
    let mantissa = f64::from_bits((shifted & MANTISSA) + HALF_ROOT);
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let z = s * s;
    let z2 = z * z;
    let z4 = z2 * z2;
    let low = (2.0 / 3.0 + z * (2.0 / 5.0)) + z2 * (2.0 / 7.0 + z * (2.0 / 9.0));
    let high = (2.0 / 11.0 + z * (2.0 / 13.0)) + z2 * (2.0 / 15.0 + z * (2.0 / 17.0));
    let series = z * (low + z4 * high + z4 * z4 * (2.0 / 19.0 + z * (2.0 / 21.0)));
    exponent * LN2_HIGH + (s * (2.0 + series) + exponent * LN2_LOW)
}

#[cfg(test)]
mod tests;
