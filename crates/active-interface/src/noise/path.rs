//! Brownian paths as functions of time.

use std::f64::consts::TAU;

/// Levels of a tree: below `2^-LEVELS` of its length, paths are straight.
const LEVELS: u32 = 24;

/// Independent Brownian paths W(t) of unit diffusion, `<(W(t) - W(s))^2> = t - s`, as functions of their number and the
/// time. All random numbers are hashes of seed, path, interval and node. An increment is therefore the same however
/// time is divided into steps.
///
/// Time is divided into intervals. Within each, the path is a bridge that is halved again and again.
#[derive(Debug, Clone)]
pub(super) struct BrownianPath {
    seed: u64,
    /// Length of an interval (time).
    length: f64,
}

/// Returns a well mixed number of a number (the finaliser of SplitMix64, Steele, Lea and Flood 2014).
fn mixed(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Returns the standard normal number of a key (Box and Muller 1958).
fn normal(key: u64, node: u64) -> f64 {
    let first = mixed(key ^ mixed(node));
    let second = mixed(first);
    let unit = |z: u64| ((z >> 11) + 1) as f64 / (1u64 << 53) as f64;
    (-2.0 * unit(first).ln()).sqrt() * (TAU * unit(second)).cos()
}

impl BrownianPath {
    pub(super) fn new(seed: u64, stream: u64, length: f64) -> Self {
        Self { seed: mixed(seed ^ mixed(stream ^ 0x6A09_E667_F3BC_C908)), length }
    }

    /// Returns `W(time + dt) - W(time)` of a path (square root of time).
    pub(super) fn increment(&self, path: u64, time: f64, dt: f64) -> f64 {
        let [start, end] = [time, time + dt].map(|time| time / self.length);
        let [first, last] = [start.floor(), end.floor()];
        let mut sum = self.within(path, last, end - last) - self.within(path, first, start - first);
        let mut interval = first;
        while interval < last {
            sum += normal(self.key(path, interval), 0);
            interval += 1.0;
        }
        sum * self.length.sqrt()
    }

    fn key(&self, path: u64, interval: f64) -> u64 {
        mixed(self.seed ^ mixed(path) ^ mixed(interval.to_bits()).rotate_left(17))
    }

    /// Returns the path from the start of an interval to a fraction of it, over the root of its length.
    fn within(&self, path: u64, interval: f64, part: f64) -> f64 {
        let key = self.key(path, interval);
        let (mut low, mut length, mut node) = (0.0, 1.0_f64, 1_u64);
        let [mut start, mut end] = [0.0, normal(key, 0)];
        for _ in 0..LEVELS {
            let middle = 0.5 * (start + end) + 0.5 * length.sqrt() * normal(key, node);
            length *= 0.5;
            if part < low + length {
                (end, node) = (middle, 2 * node);
            } else {
                (start, node) = (middle, 2 * node + 1);
                low += length;
            }
        }
        start + (end - start) * (part - low) / length
    }
}
