//! The smooth part of the images' flow: a sum over the wave vectors of the box.

use std::f64::consts::TAU;

use motile_base::internal::{dot, widely};

use super::split::Split;
use crate::surroundings::{Components, FIELDS, Sources, Targets};
use crate::waves::cos_sin;

/// Sources and targets that are treated together.
const SOURCES: usize = 128;
pub(super) const TARGETS: usize = 64;

/// Complex numbers.
type Complex = [f64; 2];

/// Wave vectors of one pair of numbers along x and y, with numbers along z from 0.
#[derive(Debug, Clone)]
pub(super) struct Column {
    x: i64,
    y: i64,
    /// For each number along z, the wave vector and its factor: `phi/(V k^2)` for the whole vector and its opposite.
    waves: Vec<([f64; 3], f64)>,
}

/// All wave vectors of a box.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    pub(super) list: Vec<Column>,
    size: [f64; 3],
    /// Largest numbers along x, y and z.
    most: [usize; 3],
}

impl Columns {
    pub(super) fn new(size: [f64; 3], cut_off: f64, split: &Split) -> Self {
        let largest = split.most() / cut_off;
        let most = size.map(|side| (largest * side / TAU) as usize);
        let volume: f64 = size.iter().product();
        let wave = |i: usize, n: i64| TAU * n as f64 / size[i];
        let mut list = Vec::new();
        let numbers = |i: usize| -(most[i] as i64)..=most[i] as i64;
        for x in numbers(0) {
            for y in numbers(1) {
                let mut waves = Vec::new();
                for z in 0..=most[2] as i64 {
                    let k = [wave(0, x), wave(1, y), wave(2, z)];
                    let square = crate::surface::dot(k, k);
                    if square.sqrt() > largest {
                        break;
                    }
                    let both = if z > 0 { 2.0 } else { 1.0 };
                    let factor = both * split.phi(square.sqrt() * cut_off) / (volume * square);
                    waves.push((k, if square > 0.0 { factor } else { 0.0 }));
                }
                if !waves.is_empty() {
                    list.push(Column { x, y, waves });
                }
            }
        }
        Self { list, size, most }
    }
}

/// Cosines and sines of all numbers along x, y and z at a block of places.
#[derive(Debug, Clone, Default)]
struct Tables {
    /// For each direction and number, cosines and sines of the places.
    waves: [Vec<[f64; SOURCES]>; 6],
}

impl Tables {
    /// Fills the tables for places from `first` on.
    #[inline(always)]
    fn fill(&mut self, columns: &Columns, places: Components<'_>, first: usize, len: usize) {
        let mut angles = [0.0; SOURCES];
        let (mut cosines, mut sines) = ([0.0; SOURCES], [0.0; SOURCES]);
        for (i, list) in places.iter().enumerate() {
            for (angle, x) in angles.iter_mut().zip(&list[first..first + len]) {
                *angle = TAU / columns.size[i] * x;
            }
            let [even, odd] = &mut self.waves[2 * i..2 * i + 2] else { return };
            even.resize(columns.most[i] + 1, [0.0; SOURCES]);
            odd.resize(columns.most[i] + 1, [0.0; SOURCES]);
            even[0] = [1.0; SOURCES];
            odd[0] = [0.0; SOURCES];
            for n in 1..=columns.most[i] {
                let multiples: [f64; SOURCES] = std::array::from_fn(|j| n as f64 * angles[j]);
                cos_sin(&multiples, &mut cosines, &mut sines);
                even[n] = cosines;
                odd[n] = sines;
            }
        }
    }

    /// Writes the cosines and sines of a column's part along x and y.
    #[inline(always)]
    fn column(&self, column: &Column, [cosines, sines]: [&mut [f64; SOURCES]; 2]) {
        let [cx, sx, cy, sy, ..] = &self.waves;
        let (x, y) = (column.x.unsigned_abs() as usize, column.y.unsigned_abs() as usize);
        let (a, b) = (column.x.signum() as f64, column.y.signum() as f64);
        for j in 0..SOURCES {
            let (cx, sx, cy, sy) = (cx[x][j], a * sx[x][j], cy[y][j], b * sy[y][j]);
            cosines[j] = cx * cy - sx * sy;
            sines[j] = sx * cy + cx * sy;
        }
    }
}

/// The columns that one thread works on.
#[derive(Debug, Clone, Default)]
pub(super) struct Share {
    pub(super) columns: Vec<usize>,
    /// For each wave vector of these columns, the amplitude of the flow.
    pub(super) amplitudes: Vec<[Complex; 3]>,
    moments: Vec<[Complex; FIELDS]>,
    tables: Tables,
    fields: Vec<[f64; SOURCES]>,
}

impl Share {
    /// Computes the amplitudes of all wave vectors of this share.
    pub(super) fn gather(&mut self, columns: &Columns, sources: &[Sources<'_>]) {
        let count = self.columns.iter().map(|&column| columns.list[column].waves.len()).sum();
        self.amplitudes.clear();
        self.amplitudes.resize(count, [[0.0; 2]; 3]);
        self.fields.resize(FIELDS, [0.0; SOURCES]);
        for source in sources {
            self.moments.clear();
            self.moments.resize(count, [[0.0; 2]; FIELDS]);
            for first in (0..source.places()[0].len()).step_by(SOURCES) {
                widely(
                    #[inline(always)]
                    || self.add_block(columns, source, first),
                );
            }
            let flow = if matches!(source, Sources::Forces { .. }) { flow_of_forces } else { flow_of_doubles };
            let waves = self.columns.iter().flat_map(|&column| &columns.list[column].waves);
            for (((k, factor), moments), sums) in waves.zip(&self.moments).zip(&mut self.amplitudes) {
                for (sum, part) in sums.iter_mut().zip(flow(*k, *factor, moments)) {
                    *sum = [sum[0] + part[0], sum[1] + part[1]];
                }
            }
        }
    }

    #[inline(always)]
    fn add_block(&mut self, columns: &Columns, source: &Sources<'_>, first: usize) {
        let (places, used) = (source.places(), source.fields());
        let len = SOURCES.min(places[0].len() - first);
        self.tables.fill(columns, places, first, len);
        for j in 0..SOURCES {
            let values = if j < len { source.values(first + j) } else { [0.0; FIELDS] };
            for (field, value) in self.fields.iter_mut().zip(values) {
                field[j] = value;
            }
        }
        let (mut across, mut along) = ([[0.0; SOURCES]; 2], [[0.0; SOURCES]; 2]);
        let mut next = 0;
        for &column in &self.columns {
            let column = &columns.list[column];
            let [even, odd] = &mut across;
            self.tables.column(column, [even, odd]);
            for z in 0..column.waves.len() {
                let (cz, sz) = (&self.tables.waves[4][z], &self.tables.waves[5][z]);
                for j in 0..SOURCES {
                    along[0][j] = across[0][j] * cz[j] - across[1][j] * sz[j];
                    along[1][j] = across[1][j] * cz[j] + across[0][j] * sz[j];
                }
                for f in 0..used {
                    self.moments[next][f][0] += dot(&along[0], &self.fields[f]);
                    self.moments[next][f][1] -= dot(&along[1], &self.fields[f]);
                }
                next += 1;
            }
        }
    }
}

/// Returns `(F - k (k.F)/k^2)` times the factor.
fn flow_of_forces(k: [f64; 3], factor: f64, moments: &[Complex; FIELDS]) -> [Complex; 3] {
    let square = crate::surface::dot(k, k).max(f64::MIN_POSITIVE);
    let along = |part: usize| (0..3).map(|i| k[i] * moments[i][part]).sum::<f64>() / square;
    let along = [along(0), along(1)];
    std::array::from_fn(|i| [0, 1].map(|part| factor * (moments[i][part] - k[i] * along[part])))
}

/// Returns `-i (S k + tr(S) k/2 - k (k S k)/k^2)` times the factor.
fn flow_of_doubles(k: [f64; 3], factor: f64, moments: &[Complex; FIELDS]) -> [Complex; 3] {
    let square = crate::surface::dot(k, k).max(f64::MIN_POSITIVE);
    let real = [0, 1].map(|part| {
        let [xx, xy, xz, yy, yz, zz] = [0, 1, 2, 3, 4, 5].map(|f: usize| moments[f][part]);
        let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let product = rows.map(|row| crate::surface::dot(row, k));
        let along = 0.5 * (xx + yy + zz) - crate::surface::dot(product, k) / square;
        std::array::from_fn::<f64, 3, _>(|i| product[i] + along * k[i])
    });
    std::array::from_fn(|i| [factor * real[1][i], -factor * real[0][i]])
}

/// Targets that one thread works on.
#[derive(Debug, Clone, Default)]
pub(super) struct Block {
    /// List of targets, and the first of them.
    pub(super) group: usize,
    pub(super) first: usize,
    pub(super) sums: Vec<[f64; TARGETS]>,
    tables: Tables,
}

impl Block {
    /// Divides targets into blocks, and returns their number. Memory only grows.
    pub(super) fn distribute(blocks: &mut Vec<Self>, targets: &[Targets<'_>]) -> usize {
        let mut count = 0;
        for (group, target) in targets.iter().enumerate() {
            for first in (0..target.places[0].len()).step_by(TARGETS) {
                if blocks.len() == count {
                    blocks.push(Self::default());
                }
                (blocks[count].group, blocks[count].first) = (group, first);
                count += 1;
            }
        }
        count
    }

    /// Computes the smooth flow at the targets of this block, with a mean.
    pub(super) fn scatter(&mut self, columns: &Columns, shares: &[Share], targets: Components<'_>, mean: [f64; 3]) {
        self.sums.clear();
        self.sums.extend(mean.map(|mean| [mean; TARGETS]));
        let len = TARGETS.min(targets[0].len() - self.first);
        widely(
            #[inline(always)]
            || {
                self.tables.fill(columns, targets, self.first, len);
                let (mut even, mut odd) = ([0.0; SOURCES], [0.0; SOURCES]);
                for share in shares {
                    let mut amplitudes = share.amplitudes.iter();
                    for &column in &share.columns {
                        let column = &columns.list[column];
                        self.tables.column(column, [&mut even, &mut odd]);
                        for z in 0..column.waves.len() {
                            let (cz, sz) = (&self.tables.waves[4][z], &self.tables.waves[5][z]);
                            let Some(amplitudes) = amplitudes.next() else { return };
                            let (mut c, mut s) = ([0.0; TARGETS], [0.0; TARGETS]);
                            for j in 0..TARGETS {
                                c[j] = even[j] * cz[j] - odd[j] * sz[j];
                                s[j] = odd[j] * cz[j] + even[j] * sz[j];
                            }
                            for (sums, [re, im]) in self.sums.iter_mut().zip(amplitudes) {
                                for j in 0..TARGETS {
                                    sums[j] += re * c[j] - im * s[j];
                                }
                            }
                        }
                    }
                }
            },
        );
    }
}
