//! Sums of many numbers in vector registers.

/// Partial sums that a loop adds to at a time: two registers of AVX, so that the additions of one need not wait for
/// those of the other.
const LANES: usize = 8;

/// Sum in eight partial sums, which the compiler keeps in vector registers.
#[must_use]
pub fn sum(values: &[f64]) -> f64 {
    let (chunks, rest) = values.as_chunks::<LANES>();
    let mut lanes = [0.0; LANES];
    for chunk in chunks {
        for lane in 0..LANES {
            lanes[lane] += chunk[lane];
        }
    }
    lanes.iter().sum::<f64>() + rest.iter().sum::<f64>()
}

/// Scalar product in eight partial sums, which the compiler keeps in vector registers; entries beyond the length of the
/// shorter list do not count.
///
/// ```
/// assert_eq!(motile_base::dot(&[1.0; 11], &[0.5; 11]), 5.5);
/// ```
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let len = a.len().min(b.len());
    let (a_chunks, a_rest) = a[..len].as_chunks::<LANES>();
    let (b_chunks, b_rest) = b[..len].as_chunks::<LANES>();
    let mut lanes = [0.0; LANES];
    for (a, b) in a_chunks.iter().zip(b_chunks) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    lanes.iter().sum::<f64>() + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f64>()
}
