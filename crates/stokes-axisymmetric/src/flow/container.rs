//! Rigid containers: closed tubes around the surfaces.

use std::f64::consts::PI;

use motile_base::{Drive, Region, TubeShape, Vec2, positive, within};
use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::{
    AxisymmetricFlow, add_waves,
    fine::Levels,
    meridian::{Grid, Meridian},
    panels::{Panels, Spot},
    ring::{Ring, Wanted},
    waves::dot,
};
use crate::refusal::short_tube;
use stokes_boundary_integrals::{LayerError, internal::DenseFactors};

/// Length of a closed tube beyond the surfaces at either end, over its radius: flows decay to 2e-11.
const BEYOND: f64 = 5.5;
/// Distance of the nodes of a tube, over its radius, and over the root of the gap and the radius next to the surfaces.
/// The drag of a sphere is right to 1e-8 in wide tubes and to 1e-7 in tight ones.
const SPACINGS: [f64; 2] = [0.085, 0.3];
/// Most nodes of a tube.
const MOST_TUBE_NODES: usize = 1600;

/// A straight tube that follows the surfaces.
#[derive(Debug, Clone)]
pub(super) struct Tube {
    pub(super) radius: f64,
    /// Half length, and the distance of the nodes for which it was made (length).
    half_length: f64,
    spacing: f64,
}

impl Tube {
    pub(super) fn new(radius: f64) -> Self {
        Self { radius, half_length: 0.0, spacing: f64::INFINITY }
    }
}

/// A rigid container at rest, with the matrix of its forces factorised. The force of a uniform pressure moves nothing:
/// with the product of this force and the normal added the matrix is regular, and forces found have no such part.
#[derive(Debug, Clone)]
pub(super) struct Walls {
    pub(super) grid: Grid,
    pub(super) meridian: Meridian,
    pub(super) panels: Panels,
    pub(super) factors: DenseFactors,
    /// Place of the container's middle (length).
    pub(super) shift: Vec2,
    /// 8 pi times viscosity times velocity at the nodes of the surfaces, by the coefficients of the forces: sines of x,
    /// cosines of r.
    onto_surfaces: DMatrix<f64>,
    /// Forces for the single layers of the surfaces, and for unit coefficients of the unknowns.
    from_forces: DVector<f64>,
    from_unknowns: DMatrix<f64>,
    /// Forces that drive a flux of 1 through the ends of a tube.
    pub(super) open: Option<DVector<f64>>,
}

/// Returns the velocity along a straight tube of a radius, per flux (1/length squared), at a distance from the axis
/// (length), and its slope: the flow of Poiseuille.
pub(super) fn poiseuille(radius: f64, r: f64) -> [f64; 2] {
    let mean = 1.0 / (PI * radius * radius);
    [2.0 * mean * (1.0 - (r / radius).powi(2)), -4.0 * mean * r / (radius * radius)]
}

/// Returns the fall of the pressure per length and flux (force times time over length to the sixth) in that flow.
pub(super) fn resistance(radius: f64, viscosity: f64) -> f64 {
    8.0 * viscosity / (PI * radius.powi(4))
}

/// Returns the points and nodes of a tube of a shape: their distance follows from its minimum radius, and from its
/// ramps and waves.
pub(super) fn nodes_of(shape: TubeShape, radius: f64, half_length: f64) -> [usize; 2] {
    let narrowest = shape.least_radius(radius);
    let spacing = (1.5 * SPACINGS[0] * narrowest).min(shape.finest_spacing(radius));
    let count = (4.0 * (half_length + radius) / spacing).clamp(64.0, MOST_TUBE_NODES as f64) as usize / 2 * 2;
    [4 * count, count]
}

impl Walls {
    pub(super) fn new(grid: Grid, mut meridian: Meridian) -> Result<Self, LayerError> {
        let n = grid.nodes;
        let mut panels = Panels::new(n);
        meridian.fix(&grid);
        let mut matrix = DMatrix::zeros(2 * n, 2 * n);
        for j in 0..n {
            let place = meridian.nodes[j].place;
            let spot = Spot { place, foot: grid.parameters[j], offset: Vec2::ZERO, gap: 0.0 };
            add_rows(&mut matrix, j, n, (&grid, &meridian), &spot, &mut panels);
        }
        let (mut x, mut r) = (vec![0.0; n], vec![0.0; n]);
        for (j, point) in meridian.nodes.iter().enumerate() {
            let normal = point.place.y * point.normal();
            (x[j], r[j]) = (normal.x, normal.y);
        }
        // r n |X_t| has sines along x and cosines from the axis, the parity of a force.
        let mut pressure = super::Pair::new(grid.largest() + 1);
        grid.analyse(&r, &x, &mut pressure);
        let null: Vec<f64> = pressure.sin[1..=n].iter().chain(&pressure.cos[..n]).copied().collect();
        let square: f64 = null.iter().map(|value| value * value).sum();
        // Entries as large as those of the matrix, in any unit of length.
        let scale = matrix.amax() / square.sqrt();
        for (j, point) in meridian.nodes.iter().enumerate() {
            let normal = scale * point.normal().normalize();
            for (k, value) in null.iter().enumerate() {
                matrix[(j, k)] += normal.x * value;
                matrix[(n + j, k)] += normal.y * value;
            }
        }
        let factors = DenseFactors::new(matrix);
        if !factors.is_regular() {
            return Err(LayerError::singular_walls());
        }
        let empty = DMatrix::zeros(0, 0);
        let from_forces = DVector::zeros(2 * n);
        let shift = Vec2::ZERO;
        let onto_surfaces = empty.clone();
        Ok(Self {
            grid,
            meridian,
            panels,
            factors,
            shift,
            onto_surfaces,
            from_forces,
            from_unknowns: empty,
            open: None,
        })
    }

    /// Takes over forces by their coefficients.
    fn settle(&mut self, forces: &DVector<f64>) {
        let (x, r) = forces.as_slice().split_at(self.grid.nodes);
        self.meridian.force.sin[1..=x.len()].copy_from_slice(x);
        self.meridian.force.cos[..r.len()].copy_from_slice(r);
        self.meridian.update_forces(&self.grid);
    }

    /// Opens the ends of a tube whose ends have this radius (length): the forces of a flow that is Poiseuille's there.
    pub(super) fn open(&mut self, viscosity: f64, radius: f64, half_length: f64) {
        let n = self.grid.nodes;
        let mut forces = DVector::zeros(2 * n);
        for (j, node) in self.meridian.nodes.iter().enumerate() {
            if node.place.x.abs() > half_length - 1.5 * radius && node.place.y < radius {
                forces[j] = 8.0 * PI * viscosity * poiseuille(radius, node.place.y)[0];
            }
        }
        self.factors.solve(&mut forces);
        self.open = Some(forces);
    }
}

/// Adds the single layer of a meridian at a spot to rows `row` and `row + n` of a matrix by coefficients of its forces.
fn add_rows(
    matrix: &mut DMatrix<f64>,
    row: usize,
    n: usize,
    source: (&Grid, &Meridian),
    spot: &Spot,
    panels: &mut Panels,
) {
    let waves = source.0.nodes;
    let mut rows = [vec![0.0; 2 * waves], vec![0.0; 2 * waves]];
    panels.each(source, spot, Wanted::Single, |source| {
        for (row, [x, r]) in rows.iter_mut().zip(source.ring.single()) {
            let factors = [source.weight * x, source.weight * r];
            add_waves(row, factors, &source.waves.sin[1..=waves], &source.waves.cos[..waves]);
        }
    });
    for (row, values) in [row, row + n].into_iter().zip(&rows) {
        for (k, value) in values.iter().enumerate() {
            matrix[(row, k)] += value;
        }
    }
}

impl AxisymmetricFlow {
    /// Brings a tube to the surfaces and rebuilds it if it is too short or its nodes are too far apart; refuses
    /// surfaces beyond the wall.
    pub(super) fn fit_walls(&mut self) -> Result<(), LayerError> {
        let nodes =
            || self.surfaces.iter().enumerate().flat_map(|(k, m)| m.nodes.iter().map(move |node| (k, node.place)));
        if let Some(Tube { radius, half_length, spacing }) = self.tube {
            let ends = nodes().fold([f64::INFINITY, -f64::INFINITY], |[a, b], (_, at)| [a.min(at.x), b.max(at.x)]);
            let widest = nodes().fold(0.0, |a: f64, (_, at)| a.max(at.y));
            if ends[0] > ends[1] {
                return Ok(());
            }
            if let Some((curve, at)) = nodes().find(|(_, at)| at.y >= radius) {
                return Err(LayerError::CrossesWall { curve, x: at.x, y: at.y, wall: 0 });
            }
            let (length, least) = (self.drive.1, ends[1] - ends[0] + Region::LENGTHS_APART * radius);
            if self.drive.0.flux().is_none() && least > length {
                return Err(short_tube(length, least));
            }
            let needed = 0.5 * (ends[1] - ends[0]) + BEYOND * radius;
            let [wide, tight] = SPACINGS;
            let least = 4.0 * (needed + 1.5 * radius) / MOST_TUBE_NODES as f64;
            let close = (wide * radius).min(tight * ((radius - widest) * widest).sqrt()).max(least);
            if needed > half_length || close < spacing {
                // Room for changes, so that small ones do not make the tube anew.
                let (half_length, spacing) = (needed + 0.5 * radius, spacing.min(0.8 * close));
                self.make_tube(radius, half_length, spacing)?;
            }
            if let Some(walls) = &mut self.walls {
                walls.shift = Vec2::new(0.5 * (ends[0] + ends[1]), 0.0);
            }
            return Ok(());
        }
        let Some(walls) = &self.walls else { return Ok(()) };
        match nodes().find(|(_, at)| !walls.meridian.holds(*at)) {
            Some((curve, Vec2 { x, y })) => Err(LayerError::CrossesWall { curve, x, y, wall: 0 }),
            None => Ok(()),
        }
    }

    fn make_tube(&mut self, radius: f64, half_length: f64, spacing: f64) -> Result<(), LayerError> {
        let count = (4.0 * (half_length + radius) / spacing).min(MOST_TUBE_NODES as f64) as usize / 2 * 2;
        self.contain(&tube(|_| radius, half_length, 4 * count)?, count)?;
        self.tube = Some(Tube { radius, half_length, spacing });
        Ok(())
    }

    /// Returns half the length of the straight tube and the distance of its nodes (length), which depend on where the
    /// surfaces have been. Returns `None` without a tube, or before there were surfaces.
    #[must_use]
    pub fn tube_resolution(&self) -> Option<[f64; 2]> {
        self.tube.as_ref().filter(|tube| tube.half_length > 0.0).map(|tube| [tube.half_length, tube.spacing])
    }

    /// Rebuilds the straight tube as it was ([`AxisymmetricFlow::tube_resolution`]), so that what is computed is that
    /// to the last bit; without one nothing changes.
    ///
    /// # Errors
    /// Returns an error for lengths that are not positive and finite.
    pub fn restore_tube(&mut self, [half_length, spacing]: [f64; 2]) -> Result<(), LayerError> {
        let Some(Tube { radius, .. }) = self.tube else { return Ok(()) };
        positive("the half length of a tube", half_length)?;
        self.make_tube(radius, half_length, positive("the distance of the nodes of a tube", spacing)?)
    }

    /// Eliminates the forces on the container from the equation of the surfaces. Its rows by coefficients are made if
    /// there is a matrix or a flux through a shaped tube; otherwise sums over the points of the wall do.
    pub(super) fn add_walls(&mut self) {
        let with_matrix = self.has_contrast();
        let Self { grid, panels, surfaces, sides, walls, drive, right, matrix, .. } = self;
        let Some(walls) = walls else { return };
        let by_rows = with_matrix || drive.0 != Drive::ZeroFlux && walls.open.is_some();
        let (n, wall_nodes, count) = (grid.nodes, walls.grid.nodes, surfaces.len());
        let mut forces = DVector::zeros(2 * wall_nodes);
        let mut unknowns = DMatrix::zeros(2 * wall_nodes, if with_matrix { 2 * n * count } else { 0 });
        let mut fine: Vec<Levels> = surfaces.iter().map(|_| Levels::default()).collect();
        for (j, node) in walls.meridian.nodes.iter().enumerate() {
            for (surface, meridian) in surfaces.iter().enumerate() {
                let contrast = sides[surface].contrast();
                let spot = meridian.spot(grid, node.place + walls.shift, panels);
                let mut rows = [(); 2].map(|()| vec![0.0; if contrast == 0.0 { 0 } else { 2 * n }]);
                let mut sum = Vec2::ZERO;
                let mut add = |weight: f64, ring: &Ring, force: Vec2| {
                    let [[xx, xr], [rx, rr]] = ring.single();
                    let force = weight * force;
                    sum += Vec2::new(xx * force.x + xr * force.y, rx * force.x + rr * force.y);
                };
                let close = if contrast == 0.0 { fine[surface].at(&spot, (grid, meridian), None) } else { None };
                if let Some(nodes) = close {
                    nodes.iter().for_each(|node| add(node.weight, &node.ring(&spot, Wanted::Single), node.force));
                } else {
                    panels.each((grid, meridian), &spot, sides[surface].wanted(), |source| {
                        add(source.weight, &source.ring, source.force_on(meridian));
                        if contrast != 0.0 {
                            let factor = contrast * source.weight * source.point.place.y;
                            for (row, [x, r]) in rows.iter_mut().zip(source.ring.double(source.point.normal())) {
                                let waves = source.waves;
                                add_waves(row, [factor * x, factor * r], &waves.cos[..n], &waves.sin[1..=n]);
                            }
                        }
                    });
                }
                forces[j] -= sum.x;
                forces[wall_nodes + j] -= sum.y;
                for (row, values) in [j, wall_nodes + j].into_iter().zip(&rows) {
                    for (k, value) in values.iter().enumerate() {
                        unknowns[(row, 2 * n * surface + k)] -= value;
                    }
                }
            }
        }
        walls.factors.solve(&mut forces);
        if with_matrix {
            walls.factors.solve(&mut unknowns);
        }
        (walls.from_forces, walls.from_unknowns) = (forces, unknowns);
        let mut onto = DMatrix::zeros(if by_rows { 2 * n * count } else { 0 }, 2 * wall_nodes);
        if !by_rows {
            let forces = walls.from_forces.clone();
            walls.settle(&forces);
        }
        for (surface, meridian) in surfaces.iter().enumerate() {
            let mut rows = DMatrix::zeros(if by_rows { 2 * n } else { 0 }, 2 * wall_nodes);
            for (j, node) in meridian.nodes.iter().enumerate() {
                let Walls { grid: wall, meridian: sides, panels, shift, .. } = &mut **walls;
                let spot = sides.spot(wall, node.place - *shift, panels);
                if by_rows {
                    add_rows(&mut rows, j, n, (wall, sides), &spot, panels);
                    continue;
                }
                panels.each((wall, sides), &spot, Wanted::Single, |source| {
                    let [[xx, xr], [rx, rr]] = source.ring.single();
                    let force = source.weight * source.force_on(sides);
                    right[2 * n * surface + j] += xx * force.x + xr * force.y;
                    right[2 * n * surface + n + j] += rx * force.x + rr * force.y;
                });
            }
            if by_rows {
                onto.rows_mut(2 * n * surface, 2 * n).copy_from(&rows);
            }
        }
        if by_rows {
            right.gemv(1.0, &onto, &walls.from_forces, 1.0);
        }
        if with_matrix {
            matrix.gemm(-1.0, &onto, &walls.from_unknowns, 1.0);
        }
        walls.onto_surfaces = onto;
    }

    /// 8 pi times viscosity times velocity at the nodes of the surfaces of a flux of 1 through the tube, where it is
    /// driven.
    pub(super) fn background(&mut self) -> Option<DVector<f64>> {
        if self.drive.0 == Drive::ZeroFlux {
            return None;
        }
        let n = self.grid.nodes;
        if let Some(Tube { radius, .. }) = self.tube {
            let mut velocities = DVector::zeros(2 * n * self.surfaces.len());
            for (surface, meridian) in self.surfaces.iter().enumerate() {
                for (j, node) in meridian.nodes.iter().enumerate() {
                    velocities[2 * n * surface + j] = 8.0 * PI * self.viscosity * poiseuille(radius, node.place.y)[0];
                }
            }
            return Some(velocities);
        }
        let walls = self.walls.as_mut()?;
        let open = walls.open.as_ref()?;
        if let Some(flux) = self.drive.0.flux() {
            walls.from_forces.axpy(flux, open, 1.0);
        }
        Some(&walls.onto_surfaces * open)
    }

    /// Returns the rise of the pressure along a straight tube (stress) by the surfaces, with the forces on them or
    /// without.
    pub(super) fn pressure_rise(&self, with_forces: bool) -> f64 {
        let Some(Tube { radius, .. }) = self.tube else { return 0.0 };
        let mut rise = 0.0;
        for ((meridian, sides), solution) in self.surfaces.iter().zip(&self.sides).zip(&self.solution) {
            for (j, (node, weight)) in meridian.nodes.iter().zip(&self.grid.weights).enumerate() {
                let [speed, slope] = poiseuille(radius, node.place.y);
                let (waves, normal) = (&self.grid.waves[j], node.normal());
                let (x, r) = (dot(&solution.cos, &waves.cos), dot(&solution.sin, &waves.sin));
                let pull = if with_forces { meridian.force_of(waves).x * speed } else { 0.0 };
                let shear = (x * normal.y + r * normal.x) * slope;
                let fall = resistance(radius, 1.0) * node.place.x * (x * normal.x + r * normal.y);
                let jump = sides.contrast() * node.place.y * (shear + fall);
                rise += 2.0 * PI * weight * (pull + jump);
            }
        }
        rise
    }

    /// Adds to the solution without flux as much of that in the flow of Poiseuille, without forces, that the mean
    /// pressure gradient is the prescribed one.
    pub(super) fn hold_pressure(
        &mut self,
        factors: Option<&LU<f64, Dyn, Dyn>>,
        mut background: DVector<f64>,
    ) -> Result<(), LayerError> {
        let Some(Tube { radius, .. }) = self.tube else { return Ok(()) };
        let (drive, length) = self.drive;
        let per_length = |rise: f64| if length.is_finite() { rise / length } else { 0.0 };
        let without = per_length(self.pressure_rise(true));
        let kept = self.solution.clone();
        self.settle(factors, &mut background)?;
        let by_flux = per_length(self.pressure_rise(false));
        self.flux = (without - drive.gradient()) / (resistance(radius, self.viscosity) - by_flux);
        for (solution, kept) in self.solution.iter_mut().zip(kept) {
            let parts = [(&mut solution.cos, kept.cos), (&mut solution.sin, kept.sin)];
            for (values, kept) in parts {
                values.iter_mut().zip(kept).for_each(|(value, kept)| *value = self.flux * *value + kept);
            }
        }
        Ok(())
    }

    /// Computes the forces on the container for the solution.
    pub(super) fn settle_walls(&mut self) {
        let Self { grid, walls, solution, .. } = self;
        let Some(walls) = walls else { return };
        let n = grid.nodes;
        let mut forces = walls.from_forces.clone();
        if walls.from_unknowns.ncols() > 0 {
            for (surface, solution) in solution.iter().enumerate() {
                for k in 0..n {
                    forces.axpy(solution.cos[k], &walls.from_unknowns.column(2 * n * surface + k), 1.0);
                    forces.axpy(solution.sin[k + 1], &walls.from_unknowns.column(2 * n * surface + n + k), 1.0);
                }
            }
        }
        walls.settle(&forces);
    }
}

/// Returns the points of a closed tube of revolution about the x axis, for [`AxisymmetricFlow::with_container`]. These
/// are the sides at the distance `radius(x)` (length) from the axis for |x| < `half_length` (length), flat ends,
/// corners rounded over about the radius there; equally spaced along a straight tube. `radius` should be constant near
/// the ends.
///
/// # Errors
/// Returns an error for a radius or length that is not positive and finite, a tube shorter than its radius, fewer than
/// 16 points or an odd number.
pub fn tube(radius: impl Fn(f64) -> f64, half_length: f64, points: usize) -> Result<Vec<Vec2>, LayerError> {
    let end = positive("the radius of a tube", radius(half_length))?;
    within("the half length of a tube over its radius", half_length / end, 1.0, 1e3)?;
    within("the number of points of a tube", points as f64, 16.0, 1e6)?;
    // Tangent angles step by a right angle at the corner of a straight tube's end, rounded by an error function.
    let (width, quarter) = (0.3 * end, end + half_length);
    let fine = 64 * points;
    let step = quarter / fine as f64;
    let angle = |s: f64| 0.25 * PI * (1.0 + erf((s - end) / width));
    let mut places = Vec::with_capacity(fine + 1);
    let mut place = Vec2::ZERO;
    places.push(place);
    for i in 0..fine {
        // Gauss points of an interval.
        for offset in [0.211_324_865_405_187_1, 0.788_675_134_594_812_9] {
            let turn = angle((i as f64 + offset) * step);
            place += 0.5 * step * Vec2::new(-turn.sin(), turn.cos());
        }
        places.push(place);
    }
    let (middle, widest) = (place.x, place.y);
    let half = points / 2;
    let mut out = vec![Vec2::ZERO; 2 * half];
    for k in 0..=half {
        let s = 2.0 * quarter * k as f64 / half as f64;
        let (s, side) = if s > quarter { (2.0 * quarter - s, -1.0) } else { (s, 1.0) };
        let i = ((s / step) as usize).min(fine - 1);
        let f = s / step - i as f64;
        // Cubic through the tangents.
        let (a, b) = (places[i], places[i + 1]);
        let slope = |j: usize| {
            let turn = angle(j as f64 * step);
            step * Vec2::new(-turn.sin(), turn.cos())
        };
        let (da, db) = (slope(i), slope(i + 1));
        let at = (1.0 - f).powi(2) * ((1.0 + 2.0 * f) * a + f * da) + f * f * ((3.0 - 2.0 * f) * b - (1.0 - f) * db);
        let x = side * (at.x - middle) * half_length / -middle;
        let r = at.y / widest * positive("the radius of a tube", radius(x))?;
        (out[k], out[(2 * half - k) % (2 * half)]) = (Vec2::new(x, r), Vec2::new(x, -r));
    }
    (out[0].y, out[half].y) = (0.0, 0.0);
    Ok(out)
}

/// Returns the error function, to round-off: its series, or the continued fraction of its complement.
fn erf(x: f64) -> f64 {
    if x.abs() > 6.0 {
        return x.signum();
    }
    let (mut term, mut sum) = (x, x);
    for n in 1..200 {
        let n = f64::from(n);
        term *= 2.0 * x * x / (2.0 * n + 1.0);
        sum += term;
        if term.abs() < 1e-17 * sum.abs() {
            break;
        }
    }
    2.0 / PI.sqrt() * (-x * x).exp() * sum
}
