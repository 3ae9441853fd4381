use super::*;
use crate::transform::second_difference;

/// Waves from the longest in a channel a million cells long to the shortest.
const WAVES: [f64; 7] = [4e-11, 1e-6, 1e-3, 0.02, 0.3, 2.0, 4.0];

const WIDTHS: [usize; 8] = [2, 3, 4, 7, 20, 41, 400, 3000];

/// `(d2 - k2) f` at the inner entries.
fn helmholtz(f: &[f64], k2: f64) -> Vec<f64> {
    f.windows(3).map(|f| (f[0] - f[1]) + (f[2] - f[1]) - k2 * f[1]).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |a, b| a.max(b.abs()))
}

/// Ghosts with the wall values 1 below and 0 above.
fn with_ghosts(f: &[f64]) -> Vec<f64> {
    [&[2.0 - f[0]], f, &[-f[f.len() - 1]]].concat()
}

#[test]
fn the_intermediate_velocity_is_harmonic() {
    for (k2, n) in WAVES.into_iter().flat_map(|k2| WIDTHS.map(|n| (k2, n))) {
        let response = WallResponse::new(k2, n);
        let residual = largest(&helmholtz(&with_ghosts(&response.harmonic), k2));
        // The exponents, up to k n, are rounded.
        let round_off = f64::EPSILON * (16.0 + k2.sqrt() * n as f64);
        assert!(residual < round_off, "{k2}, {n}: {residual:e} above {round_off:e}");
    }
}

#[test]
fn the_velocity_is_that_of_a_streamfunction_between_walls() {
    for (k2, n) in WAVES.into_iter().flat_map(|k2| WIDTHS.map(|n| (k2, n))) {
        let u = WallResponse::new(k2, n).velocity;
        let mut psi = vec![0.0];
        psi.extend(u.iter().scan(0.0, |sum, u| {
            *sum += u;
            Some(*sum)
        }));
        assert!(psi[n].abs() < 1e-14 * n as f64, "flux of {k2}, {n}: {:e}", psi[n]);
        // The vorticity within and on the walls, then its equation.
        let vorticity = helmholtz(&[&[psi[1] - 2.0], &psi[..], &[psi[n - 1]]].concat(), k2);
        let residual = largest(&helmholtz(&vorticity, k2));
        // Fourth differences of psi.
        let round_off = 16.0 * f64::EPSILON * (16.0 + largest(&psi));
        assert!(residual < round_off, "{k2}, {n}: {residual:e} above {round_off:e}");
    }
}

#[test]
fn the_slip_is_what_the_projection_leaves() {
    // The potential of the harmonic velocity by a direct solution, and the velocity that it leaves at the walls.
    for (nx, n) in [(12, 2), (12, 5), (40, 16), (7, 31)] {
        let k2 = second_difference(1, nx);
        let response = WallResponse::new(k2, n);
        for (sign, slip) in [(1.0, response.slip[0]), (-1.0, response.slip[1])] {
            let f: Vec<f64> = (0..n).map(|j| response.harmonic[j] + sign * response.harmonic[n - 1 - j]).collect();
            let potential = neumann(&f, k2);
            assert!((1.0 + k2 * potential[0] - slip).abs() < 1e-12, "{nx}, {n}, {sign}");
            for j in 0..n {
                let u = (f[j] + k2 * potential[j]) / slip;
                let expected = response.velocity[j] + sign * response.velocity[n - 1 - j];
                assert!((u - expected).abs() < 1e-11, "{nx}, {n}, {sign}, row {j}: {u} and {expected}");
            }
        }
    }
}

/// The solution of `(d2 - k2) p = f` without slopes at the ends, by elimination.
fn neumann(f: &[f64], k2: f64) -> Vec<f64> {
    let n = f.len();
    let (mut pivots, mut p) = (vec![0.0; n], vec![0.0; n]);
    let mut carried = (0.0, 0.0);
    for j in 0..n {
        let ends = f64::from(u8::from(j == 0)) + f64::from(u8::from(j + 1 == n));
        pivots[j] = 1.0 / (ends - 2.0 - k2 - carried.0);
        p[j] = (f[j] - carried.1) * pivots[j];
        carried = (pivots[j], p[j]);
    }
    for j in (0..n - 1).rev() {
        p[j] -= pivots[j] * p[j + 1];
    }
    p
}
