//! Intermediate velocities at the walls that the next solution takes over.

use motile_base::{InputError, internal::all_finite, same_length, within};

/// Numbers for each wave number: real and imaginary part at the bottom, then at the top.
const NUMBERS: usize = 4;

/// Values of the intermediate velocity at both walls, in the solution before and for the next one.
#[derive(Debug, Clone)]
pub(crate) struct LaggedWalls {
    /// Solutions so far, two for more; then the values for the next solution, then the values used in the last one.
    /// Then the number of rows of cells, by which the memory of another grid is known.
    numbers: Vec<f64>,
    /// These values after the present solution.
    coming: Vec<f64>,
}

impl LaggedWalls {
    pub(crate) fn new(waves: usize, rows: usize) -> Self {
        let count = 2 * NUMBERS * waves;
        let mut numbers = vec![0.0; count + 2];
        numbers[count + 1] = rows as f64;
        Self { numbers, coming: vec![0.0; count] }
    }

    /// Returns all that the next solution depends on besides its arguments; empty before the first one.
    pub(crate) fn memory(&self) -> &[f64] {
        if self.known() { &self.numbers } else { &[] }
    }

    pub(crate) fn set_memory(&mut self, memory: &[f64]) -> Result<(), InputError> {
        if memory.is_empty() {
            self.numbers[0] = 0.0;
            return Ok(());
        }
        same_length("the memory of a solver with lagged walls", self.numbers.len(), memory.len())?;
        all_finite("the memory of a solver with lagged walls", memory)?;
        let last = memory.len() - 1;
        within("the solutions in the memory of a solver with lagged walls", memory[0], 1.0, 2.0)?;
        let rows = self.numbers[last];
        within("the rows of cells in the memory of a solver with lagged walls", memory[last], rows, rows)?;
        self.numbers.copy_from_slice(memory);
        Ok(())
    }

    /// Takes back the last solution, so that the next one starts from the same values. The first one starts from none.
    pub(crate) fn rewind(&mut self) {
        if self.numbers[0] < 2.0 {
            self.numbers[0] = 0.0;
        }
        let count = self.coming.len();
        let (next, used) = self.numbers[1..=count].split_at_mut(count / 2);
        next.copy_from_slice(used);
    }

    /// Returns the values at the bottom and at the top for the next solution, of one part (real or imaginary) of a wave
    /// number.
    pub(crate) fn next(&self, m: usize, part: usize) -> Option<[f64; 2]> {
        self.known().then(|| self.at(1, m, part))
    }

    /// That of the last solution.
    pub(crate) fn used(&self, m: usize, part: usize) -> Option<[f64; 2]> {
        self.known().then(|| self.at(1 + self.coming.len() / 2, m, part))
    }

    /// Returns the values of the last solution minus the values of the next one: the velocity by which the fluid slips.
    pub(crate) fn slip(&self, m: usize, part: usize) -> [f64; 2] {
        let values = self.used(m, part).zip(self.next(m, part));
        values.map_or([0.0; 2], |(used, next)| [used[0] - next[0], used[1] - next[1]])
    }

    /// Notes values of the present solution and of the one after it.
    pub(crate) fn note(&mut self, m: usize, part: usize, used: [f64; 2], next: [f64; 2]) {
        let half = self.coming.len() / 2;
        for wall in 0..2 {
            let place = place(m, part, wall);
            self.coming[place] = next[wall];
            self.coming[half + place] = used[wall];
        }
    }

    /// Adds to the values for the next solution of a wave number, at the bottom and at the top.
    pub(crate) fn move_next(&mut self, m: usize, part: usize, by: [f64; 2]) {
        for (wall, by) in by.into_iter().enumerate() {
            self.numbers[1 + place(m, part, wall)] += by;
        }
    }

    /// Returns true if the values of the present solution are numbers that the next one can start from.
    pub(crate) fn is_finite(&self) -> bool {
        self.coming.iter().all(|value| value.is_finite())
    }

    /// Makes the present solution the last one.
    pub(crate) fn advance(&mut self) {
        self.numbers[0] = (self.numbers[0] + 1.0).min(2.0);
        self.numbers[1..=self.coming.len()].copy_from_slice(&self.coming);
    }

    fn known(&self) -> bool {
        self.numbers[0] > 0.0
    }

    fn at(&self, first: usize, m: usize, part: usize) -> [f64; 2] {
        [0, 1].map(|wall| self.numbers[first + place(m, part, wall)])
    }
}

fn place(m: usize, part: usize, wall: usize) -> usize {
    NUMBERS * m + 2 * wall + part
}
