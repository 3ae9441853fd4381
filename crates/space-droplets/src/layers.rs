//! Single and double layer of a droplet at the nodes of its Gauss grid.

use std::f64::consts::{PI, TAU};

use motile_base::internal::widely;
use sphere_harmonics::{Grid, HarmonicsError};
use stokes_boundary_integrals::internal::{MOST_SHARES, each_share};

use crate::polar::{FIELDS, LANES, Lanes, Polar, Work, ZERO};

/// The components of a vector field: coefficients or values.
pub(crate) type Vectors = [Vec<f64>; 3];

/// Four targets of a northern row, and their antipodes.
#[derive(Debug, Clone)]
struct Tile {
    row: usize,
    first: usize,
    /// Longitudes; the last tile of a row repeats its last column.
    phi: [f64; LANES],
    /// Places of the targets and of their antipodes among the nodes.
    nodes: [[usize; LANES]; 2],
    /// Positions of both, by component and lane.
    positions: [[[f64; LANES]; 3]; 2],
    /// Results of both.
    sums: [[[f64; LANES]; 3]; 2],
    /// Rows of the double layer: for each harmonic the components xx, xy, xz, yy, yz, zz.
    double: [Vec<Lanes>; 2],
    /// The double layer of a constant velocity, which is subtracted.
    constant: [[[f64; LANES]; FIELDS]; 2],
}

/// The tiles that one thread works on, one after the other.
#[derive(Debug, Clone)]
struct Share {
    tiles: Vec<Tile>,
    work: Work,
    kernels: [Vec<Lanes>; 2],
}

/// The layer potentials of one droplet.
#[derive(Debug, Clone)]
pub(crate) struct Layers {
    polar: Polar,
    shares: Vec<Share>,
    /// True if only the first targets of each row and their antipodes are asked for.
    pub(crate) first_only: bool,
}

/// The field `f` of a point.
#[inline(always)]
fn lanes(point: &Lanes, f: usize) -> [f64; LANES] {
    let mut field = [0.0; LANES];
    field.copy_from_slice(&point[f * LANES..(f + 1) * LANES]);
    field
}

/// Adds the flow of the force densities at a point (fields 3 to 5) to the velocities at the targets.
#[inline(always)]
fn stokeslet(weight: f64, point: &Lanes, target: &[[f64; LANES]; 3], sums: &mut [[f64; LANES]; 3]) {
    let [x, y, z] = [lanes(point, 0), lanes(point, 1), lanes(point, 2)];
    let [fx, fy, fz] = [lanes(point, 3), lanes(point, 4), lanes(point, 5)];
    for t in 0..LANES {
        let (rx, ry, rz) = (x[t] - target[0][t], y[t] - target[1][t], z[t] - target[2][t]);
        let inverse = 1.0 / (rx * rx + ry * ry + rz * rz).sqrt();
        let along = inverse * inverse * (rx * fx[t] + ry * fy[t] + rz * fz[t]);
        let scale = weight * inverse;
        sums[0][t] += scale * (fx[t] + along * rx);
        sums[1][t] += scale * (fy[t] + along * ry);
        sums[2][t] += scale * (fz[t] + along * rz);
    }
}

/// Returns the stresslet kernel `-6 w r_i r_j (r.n)/r^5` at a point with the normal times area in fields 3 to 5.
#[inline(always)]
fn stresslet(weight: f64, point: &Lanes, target: &[[f64; LANES]; 3]) -> Lanes {
    let [x, y, z] = [lanes(point, 0), lanes(point, 1), lanes(point, 2)];
    let [nx, ny, nz] = [lanes(point, 3), lanes(point, 4), lanes(point, 5)];
    let mut kernel = ZERO;
    for t in 0..LANES {
        let (rx, ry, rz) = (x[t] - target[0][t], y[t] - target[1][t], z[t] - target[2][t]);
        let square = rx * rx + ry * ry + rz * rz;
        let scale = -6.0 * weight * (rx * nx[t] + ry * ny[t] + rz * nz[t]) / (square * square * square.sqrt());
        let products = [rx * rx, rx * ry, rx * rz, ry * ry, ry * rz, rz * rz];
        for (f, product) in products.iter().enumerate() {
            kernel[f * LANES + t] = scale * product;
        }
    }
    kernel
}

/// Places of the components of a symmetric matrix.
const SYMMETRIC: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

impl Layers {
    /// Creates the layers for the nodes of a Gauss grid, with that many rings and points per ring.
    pub(crate) fn new(grid: &Grid, rings: usize, columns: usize) -> Result<Self, HarmonicsError> {
        let polar = Polar::new(grid.degree(), grid.colatitudes(), rings, columns)?;
        let (rows, columns) = (grid.rows(), grid.columns());
        let tile = |row: usize, first: usize| {
            // The antipodes of the equator's first half are its second half.
            let last = if 2 * row + 1 == rows { columns / 2 } else { columns } - 1;
            let column = |t: usize| (first + t).min(last);
            let antipode = |j: usize| (rows - 1 - row) * columns + (j + columns / 2) % columns;
            Tile {
                row,
                first,
                phi: std::array::from_fn(|t| column(t) as f64 * TAU / columns as f64),
                nodes: [
                    std::array::from_fn(|t| row * columns + column(t)),
                    std::array::from_fn(|t| antipode(column(t))),
                ],
                positions: [[[0.0; LANES]; 3]; 2],
                sums: [[[0.0; LANES]; 3]; 2],
                double: [Vec::new(), Vec::new()],
                constant: [[[0.0; LANES]; FIELDS]; 2],
            }
        };
        let mut tiles = Vec::new();
        for row in 0..rows.div_ceil(2) {
            let used = if 2 * row + 1 == rows { columns / 2 } else { columns };
            tiles.extend((0..used).step_by(LANES).map(|first| tile(row, first)));
        }
        let share =
            |tiles: &[Tile]| Share { tiles: tiles.to_vec(), work: polar.work(), kernels: [Vec::new(), Vec::new()] };
        let shares = tiles.chunks(tiles.len().div_ceil(MOST_SHARES)).map(share).collect();
        Ok(Self { polar, shares, first_only: false })
    }

    /// Places the targets at the nodes.
    pub(crate) fn place(&mut self, nodes: &Vectors) {
        for tile in self.shares.iter_mut().flat_map(|share| &mut share.tiles) {
            for (positions, places) in tile.positions.iter_mut().zip(&tile.nodes) {
                for (component, values) in positions.iter_mut().zip(nodes) {
                    *component = places.map(|k| values[k]);
                }
            }
        }
    }

    /// Writes `INT G f dA/(8 pi)` at the nodes, with G of viscosity 1, for the coefficients of positions and of
    /// forces per area of the unit sphere.
    pub(crate) fn single(&mut self, positions: [&[f64]; 3], forces: [&[f64]; 3], out: &mut Vectors) {
        let (polar, first_only) = (&self.polar, self.first_only);
        let [x, y, z] = positions;
        let fields = [x, y, z, forces[0], forces[1], forces[2]];
        each_share(&mut self.shares, |share| {
            let Share { tiles, work, .. } = share;
            for tile in tiles.iter_mut().filter(|tile| !first_only || tile.first == 0) {
                tile.single(polar, work, &fields);
            }
        });
        self.scatter(1.0 / (8.0 * PI), out);
    }

    /// Prepares the double layer for the coefficients of positions and of the normal times area.
    pub(crate) fn prepare_double(&mut self, positions: [&[f64]; 3], normals: [&[f64]; 3]) {
        let (polar, first_only) = (&self.polar, self.first_only);
        let [x, y, z] = positions;
        let fields = [x, y, z, normals[0], normals[1], normals[2]];
        each_share(&mut self.shares, |share| {
            let Share { tiles, work, kernels } = share;
            for kernel in &mut *kernels {
                kernel.resize(polar.points(), ZERO);
            }
            for tile in tiles.iter_mut().filter(|tile| !first_only || tile.first == 0) {
                tile.prepare(polar, work, kernels, &fields);
            }
        });
    }

    /// Writes `INT T (u - u0) n dA/(8 pi)` at the nodes for the coefficients of u and its values u0 at the nodes.
    pub(crate) fn double(&mut self, velocities: [&[f64]; 3], at_nodes: &Vectors, out: &mut Vectors) {
        let first_only = self.first_only;
        each_share(&mut self.shares, |share| {
            for tile in share.tiles.iter_mut().filter(|tile| !first_only || tile.first == 0) {
                tile.double(&velocities, at_nodes);
            }
        });
        self.scatter(1.0 / (8.0 * PI), out);
    }

    /// Distributes the sums of the tiles to the nodes.
    fn scatter(&self, factor: f64, out: &mut Vectors) {
        for tile in self.shares.iter().flat_map(|share| &share.tiles) {
            for (sums, places) in tile.sums.iter().zip(&tile.nodes) {
                for (sums, values) in sums.iter().zip(&mut *out) {
                    for (sum, &place) in sums.iter().zip(places) {
                        values[place] = factor * sum;
                    }
                }
            }
        }
    }
}

impl Tile {
    fn single(&mut self, polar: &Polar, work: &mut Work, fields: &[&[f64]; FIELDS]) {
        widely(
            #[inline(always)]
            || {
                polar.turn(work, fields, self.phi);
                polar.tilt(work, self.row);
                let [mut north, mut south] = [[[0.0; LANES]; 3]; 2];
                let [at_north, at_south] = self.positions;
                polar.visit(
                    work,
                    #[inline(always)]
                    |weight, point| {
                        stokeslet(weight, point, &at_north, &mut north);
                        stokeslet(weight, point, &at_south, &mut south);
                    },
                );
                self.sums = [north, south];
            },
        );
    }

    fn prepare(&mut self, polar: &Polar, work: &mut Work, kernels: &mut [Vec<Lanes>; 2], fields: &[&[f64]; FIELDS]) {
        widely(
            #[inline(always)]
            || {
                polar.turn(work, fields, self.phi);
                polar.tilt(work, self.row);
                let positions = self.positions;
                let mut next = 0;
                let [north, south] = &mut *kernels;
                polar.visit(
                    work,
                    #[inline(always)]
                    |weight, point| {
                        north[next] = stresslet(weight, point, &positions[0]);
                        south[next] = stresslet(weight, point, &positions[1]);
                        next += 1;
                    },
                );
                for (side, kernels) in kernels.iter().enumerate() {
                    let mut total = ZERO;
                    for kernel in kernels {
                        for c in 0..FIELDS * LANES {
                            total[c] += kernel[c];
                        }
                    }
                    self.constant[side] = std::array::from_fn(|f| lanes(&total, f));
                    let sums = &mut self.double[side];
                    sums.resize(work.turned.len(), ZERO);
                    polar.gather(work, kernels, (self.row, self.phi), sums);
                }
            },
        );
    }

    fn double(&mut self, velocities: &[&[f64]; 3], at_nodes: &Vectors) {
        let len = count_of(velocities);
        widely(
            #[inline(always)]
            || {
                for side in 0..2 {
                    let mut sums = [[0.0; LANES]; 3];
                    let [x, y, z] = velocities.map(|field| &field[..len]);
                    for (k, rows) in self.double[side][..len].iter().enumerate() {
                        let u = [x[k], y[k], z[k]];
                        for i in 0..3 {
                            for j in 0..3 {
                                for t in 0..LANES {
                                    sums[i][t] += rows[SYMMETRIC[i][j] * LANES + t] * u[j];
                                }
                            }
                        }
                    }
                    for i in 0..3 {
                        for j in 0..3 {
                            for t in 0..LANES {
                                let own = at_nodes[j][self.nodes[side][t]];
                                sums[i][t] -= self.constant[side][SYMMETRIC[i][j]][t] * own;
                            }
                        }
                    }
                    self.sums[side] = sums;
                }
            },
        );
    }
}

/// Returns the number of coefficients of a field.
#[inline(always)]
fn count_of(fields: &[&[f64]; 3]) -> usize {
    fields[0].len()
}
