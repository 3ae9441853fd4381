//! Intermediate velocities at the walls that the next solution takes over.

use motile_base::{InputError, all_finite, same_length};

/// Numbers for each wave number: real and imaginary part at the bottom, then at the top.
const NUMBERS: usize = 4;

/// Values of the intermediate velocity at both walls, in the solution before and for the next one.
#[derive(Debug, Clone)]
pub(crate) struct LaggedWalls {
    /// Those of the next solution; of no meaning if not `known`.
    next: Vec<f64>,
    /// Those of the last solution.
    used: Vec<f64>,
    /// Those of the next solution while the present one is computed.
    coming: Vec<f64>,
    known: bool,
}

impl LaggedWalls {
    pub(crate) fn new(waves: usize) -> Self {
        let zeros = vec![0.0; NUMBERS * waves];
        Self { next: zeros.clone(), used: zeros.clone(), coming: zeros, known: false }
    }

    /// The values for the next solution, all that it depends on besides its arguments; empty before the first one.
    pub(crate) fn memory(&self) -> &[f64] {
        if self.known { &self.next } else { &[] }
    }

    pub(crate) fn set_memory(&mut self, memory: &[f64]) -> Result<(), InputError> {
        if !memory.is_empty() {
            same_length("the memory of a solver with lagged walls", self.next.len(), memory.len())?;
            all_finite("the memory of a solver with lagged walls", memory)?;
            self.next.copy_from_slice(memory);
        }
        self.known = !memory.is_empty();
        Ok(())
    }

    /// Values at the bottom and at the top for the next solution, of one part (real or imaginary) of a wave number.
    pub(crate) fn next(&self, m: usize, part: usize) -> Option<[f64; 2]> {
        self.known.then(|| at(&self.next, m, part))
    }

    /// The same of the last solution.
    pub(crate) fn used(&self, m: usize, part: usize) -> Option<[f64; 2]> {
        self.known.then(|| at(&self.used, m, part))
    }

    /// What the last solution used minus what the next one will: the velocity by which the fluid slips.
    pub(crate) fn slip(&self, m: usize, part: usize) -> [f64; 2] {
        let ([bottom, top], [next_bottom, next_top]) = (at(&self.used, m, part), at(&self.next, m, part));
        if self.known { [bottom - next_bottom, top - next_top] } else { [0.0; 2] }
    }

    /// Notes values of the present solution and of the one after it.
    pub(crate) fn note(&mut self, m: usize, part: usize, used: [f64; 2], coming: [f64; 2]) {
        for wall in 0..2 {
            let place = place(m, part, wall);
            self.used[place] = used[wall];
            self.coming[place] = coming[wall];
        }
    }

    /// Makes the present solution the last one.
    pub(crate) fn advance(&mut self) {
        std::mem::swap(&mut self.next, &mut self.coming);
        self.known = true;
    }
}

fn place(m: usize, part: usize, wall: usize) -> usize {
    NUMBERS * m + 2 * wall + part
}

fn at(values: &[f64], m: usize, part: usize) -> [f64; 2] {
    [0, 1].map(|wall| values[place(m, part, wall)])
}
