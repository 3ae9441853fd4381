//! Solvers of a periodic box, in units of one real transform there and back of the same size in the same run.

mod support;

use std::hint::black_box;
use std::time::Duration;

use num_complex::Complex64;
use stokes_grid::{Grid, PeriodicStokes, RealFft2, StaggeredField, StokesSolver};
use support::{PlainPair, medians};

fn main() {
    println!("{:>6} {:>12} {:>12} {:>12} {:>8} {:>8}", "n", "plain pair", "own pair", "solve", "/plain", "/own");
    for n in [120, 128, 240, 256, 480, 512, 1024] {
        let grid = Grid::periodic(n, n, 0.05).unwrap();
        let mut solver = PeriodicStokes::new(grid, 100.0).unwrap();
        let wave = |k: f64| (0..n * n).map(|i| (k * (i * i) as f64).sin()).collect::<Vec<_>>();
        let force = StaggeredField::from_components(grid, wave(1.0), wave(2.0)).unwrap();
        let mut velocity = StaggeredField::zeros(grid);
        let mut plain = PlainPair::new(n, n);
        let mut own = RealFft2::new(n, n).unwrap();
        let mut space = wave(3.0);
        let mut spectrum = vec![Complex64::ZERO; own.spectrum_width() * n];
        let scale = 1.0 / (n * n) as f64;
        let mut solve = || {
            black_box(solver.solve(black_box(&force), &mut velocity).unwrap());
        };
        let mut pair = || {
            space.iter_mut().for_each(|x| *x *= scale);
            own.forward(&space, &mut spectrum).unwrap();
            own.inverse(&spectrum, &mut space).unwrap();
            black_box(&space);
        };
        let times = medians(&mut [&mut || plain.run(), &mut pair, &mut solve], Duration::from_secs(1));
        let [plain, own, solve] = times[..] else { unreachable!() };
        println!(
            "{n:>6} {:>9.1} us {:>9.1} us {:>9.1} us {:>8.2} {:>8.2}",
            plain * 1e6,
            own * 1e6,
            solve * 1e6,
            solve / plain,
            solve / own
        );
    }
}
