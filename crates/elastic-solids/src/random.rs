//! Random numbers as functions of what they are drawn for.

/// Steps of the Weyl sequences of the three keys: odd parts of the square roots of 5, 2 and 3.
const WEYL: [u64; 3] = [0x9E37_79B9_7F4A_7C15, 0x6A09_E667_F3BC_C909, 0xBB67_AE85_84CA_A73B];

/// Returns the finaliser of SplitMix64 (Steele, Lea and Flood 2014): a bijection that mixes all bits.
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Returns a number from 0 to below 1, evenly distributed and independent for other keys: a seed, an object, and a
/// step.
pub(crate) fn uniform(seed: u64, object: u64, step: u64) -> f64 {
    let keys = [seed, object, step];
    let mixed = keys.iter().zip(WEYL).fold(0, |z, (key, weyl)| mix(z ^ key.wrapping_add(1).wrapping_mul(weyl)));
    (mixed >> 11) as f64 * (0.5_f64).powi(53)
}

#[cfg(test)]
mod tests;
