//! Keeping numbers of particles from becoming negative.

/// Fills up negative numbers from neighbours that have some, as far as these have any, so that the sum stays: passes
/// over the edges until none is negative, at most as many as are given. Returns how many particles were moved.
pub(super) fn fill_up(edges: &[[usize; 2]], numbers: &mut [f64], passes: usize) -> f64 {
    let mut moved = 0.0;
    for _ in 0..passes {
        if numbers.iter().all(|&number| number >= 0.0) {
            break;
        }
        for &[i, j] in edges {
            for (poor, rich) in [(i, j), (j, i)] {
                if numbers[poor] < 0.0 && numbers[rich] > 0.0 {
                    let given = (-numbers[poor]).min(numbers[rich]);
                    numbers[poor] += given;
                    numbers[rich] -= given;
                    moved += given;
                }
            }
        }
    }
    moved
}
