//! Loops in vector registers, and sums of many numbers.

/// Partial sums that a loop adds to at a time: two registers of AVX, so that the additions of one need not wait for
/// the additions of the other.
const LANES: usize = 8;

/// Does work whose loops are compiled once for AVX2 and once for the plain instructions, with the widest that the
/// machine has. No product is fused with a sum, so that all machines get the same bits. What the work calls has to be
/// inlined to be part of it.
///
/// ```
/// use motile_base::internal::{dot, widely};
///
/// let rows = vec![vec![0.5; 11]; 3];
/// let products = widely(#[inline(always)] || rows.iter().map(|row| dot(row, &[1.0; 11])).sum::<f64>());
/// assert_eq!(products, 16.5);
/// ```
#[inline(always)]
pub fn widely<R>(work: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(work)
}

/// Returns the sum in eight partial sums, which the compiler keeps in vector registers.
#[must_use]
#[inline(always)]
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

/// Returns the scalar product in eight partial sums, which the compiler keeps in vector registers; entries beyond the
/// length of the shorter list do not count.
///
/// ```
/// assert_eq!(motile_base::internal::dot(&[1.0; 11], &[0.5; 11]), 5.5);
/// ```
#[must_use]
#[inline(always)]
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
