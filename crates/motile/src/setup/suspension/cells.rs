//! Lists of what lies in the cells of a region.

use motile_base::{Region, Vec2};

/// Numbered places of a region, sorted into cells no smaller than a reach, within which neighbours are found.
pub(super) struct Cells {
    lengths: Vec2,
    counts: [usize; 2],
    /// True in y where the region is periodic, as it is in x.
    wraps: bool,
    lists: Vec<Vec<usize>>,
}

impl Cells {
    /// Creates empty cells of a region for neighbours within `reach` (length), some `count` of them.
    pub(super) fn new(region: &Region, reach: f64, count: usize) -> Self {
        let lengths = region.lengths();
        let most = (count as f64).sqrt().ceil().max(1.0) * 2.0;
        let counts = lengths.map(|length| (length / reach).floor().clamp(1.0, most) as usize);
        let wraps = region.periods()[1].is_some();
        Self { lengths: lengths.into(), counts, wraps, lists: vec![Vec::new(); counts[0] * counts[1]] }
    }

    /// Returns the cell of a place, in x and y.
    fn cell(&self, place: Vec2) -> [usize; 2] {
        [0, 1].map(|axis| {
            let part = place[axis] / self.lengths[axis] + 0.5;
            ((part * self.counts[axis] as f64).floor().max(0.0) as usize).min(self.counts[axis] - 1)
        })
    }

    /// Adds a number at a place within the region.
    pub(super) fn add(&mut self, number: usize, place: Vec2) {
        let [x, y] = self.cell(place);
        self.lists[x + self.counts[0] * y].push(number);
    }

    /// Takes all numbers out, keeping the memory.
    pub(super) fn clear(&mut self) {
        self.lists.iter_mut().for_each(Vec::clear);
    }

    /// Returns the numbers in the cell of a place and those around it, each once.
    pub(super) fn near(&self, place: Vec2) -> impl Iterator<Item = usize> + '_ {
        let [x, y] = self.cell(place);
        let columns = around(x, self.counts[0], true);
        let wraps = self.wraps;
        let cells = columns.flat_map(move |x| around(y, self.counts[1], wraps).map(move |y| x + self.counts[0] * y));
        cells.flat_map(|cell| self.lists[cell].iter().copied())
    }
}

/// Returns the neighbours of a number below `count`, and itself, each once.
fn around(number: usize, count: usize, wraps: bool) -> impl Iterator<Item = usize> {
    let steps = if count < 3 { 0..count } else { 0..3 };
    steps.filter_map(move |step| {
        if count < 3 {
            return Some(step);
        }
        let next = number + count + step - 1;
        (wraps || (count..2 * count).contains(&next)).then_some(next % count)
    })
}
