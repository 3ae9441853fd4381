//! Cosines and sines of many angles, in vector registers.

/// Rounds to the nearest integer when it is added and subtracted; then the integer is in the lowest bits of the sum.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// A quarter of a turn in three parts of few digits, so that multiples of the first two are exact.
const QUARTER: [f64; 3] = [1.570_796_251_296_997, 7.549_789_415_861_596e-8, 5.390_302_858_158_119e-15];
/// Coefficients of the sine and the cosine for angles up to an eighth of a turn (Moshier, Cephes Mathematical Library).
const SINE: [f64; 6] = [
    1.589_623_015_765_465_7e-10,
    -2.505_074_776_285_780_7e-8,
    2.755_731_362_138_572_5e-6,
    -1.984_126_982_958_954e-4,
    8.333_333_333_322_118e-3,
    -1.666_666_666_666_663e-1,
];
const COSINE: [f64; 6] = [
    -1.135_853_652_138_768_2e-11,
    2.087_570_084_197_473e-9,
    -2.755_731_417_929_674e-7,
    2.480_158_728_885_170_4e-5,
    -1.388_888_888_887_305_6e-3,
    4.166_666_666_666_659_3e-2,
];

/// Writes the cosines and sines of angles up to some millions (radians), with errors of 2e-16 and the angle's own
/// round-off.
#[inline(always)]
pub(crate) fn cos_sin(angles: &[f64], cosines: &mut [f64], sines: &mut [f64]) {
    for ((&angle, cosine), sine) in angles.iter().zip(cosines).zip(sines) {
        let shifted = angle * std::f64::consts::FRAC_2_PI + ROUND;
        let quarters = shifted - ROUND;
        let x = ((angle - quarters * QUARTER[0]) - quarters * QUARTER[1]) - quarters * QUARTER[2];
        let square = x * x;
        let polynomial = |terms: [f64; 6]| terms.iter().skip(1).fold(terms[0], |sum, term| sum * square + term);
        let s = x + x * square * polynomial(SINE);
        let c = 1.0 - 0.5 * square + square * square * polynomial(COSINE);
        let turn = shifted.to_bits();
        let (a, b) = if turn & 1 == 0 { (c, s) } else { (s, c) };
        *cosine = f64::from_bits(a.to_bits() ^ (((turn + 1) & 2) << 62));
        *sine = f64::from_bits(b.to_bits() ^ ((turn & 2) << 62));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosines_and_sines_are_those_of_the_library() {
        let angles: Vec<f64> = (-4000..4000).map(|k| 0.37 * f64::from(k) + 1e-3).chain([0.0, 1e-9, 1e5]).collect();
        let (mut cosines, mut sines) = (vec![0.0; angles.len()], vec![0.0; angles.len()]);
        cos_sin(&angles, &mut cosines, &mut sines);
        for ((angle, cosine), sine) in angles.iter().zip(&cosines).zip(&sines) {
            let (s, c) = angle.sin_cos();
            assert!((c - cosine).abs() < 4e-16 && (s - sine).abs() < 4e-16, "{angle}: {cosine} {sine}");
        }
    }
}
