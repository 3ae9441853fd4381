//! Contribution of the straight walls of a channel to layers, and the flow that the drive of the channel drives.

use std::{array, f64::consts::TAU, ops::Range};

use num_complex::Complex64;

use super::wall_images::WallImages;
use crate::{
    LayerError,
    close_weights::reach,
    curve::Curve,
    density::Density,
    greens::{
        Flow, Vectors,
        walls::{Slipping, Uncorrected, WallModes, WallPoints},
    },
    plan::{Plan, Plans},
    shares,
    transforms::{REFINEMENT, Transforms},
};
use motile_base::{Drive, ImposedFlow, InputError, Vec2};

/// Fraction of the half width by which a node may lie beyond a wall: round-off of positions that touch it, which are
/// sums of about a thousand steps.
const ROUND_OFF: f64 = 1e-12;
/// Distance from a wall, in spacings, below which sources count as that far away: a twelfth of the distance of fine
/// nodes, at which a wall's modes are no longer resolved in any case.
const LEAST_GAP: f64 = 0.02;

/// Most nodes in place of each node that images are summed over: as many as resolve a gap of [`LEAST_GAP`] at a
/// tolerance of 1e-5.
const MOST_NODES: usize = 64;

/// Most nodes of all curves for which images in walls are summed in closed form: their factors take 32 MB.
const MOST_IMAGES: usize = 1000;

/// Cost of the images of a pair of nodes in both walls, over the cost of a source for one mode (measured).
const PAIR: f64 = 3.5;
/// Cost of an image that is close to a curve for each node of the curve, over the same cost (measured).
const CLOSE: f64 = 50.0;

/// Distance in spacings that images of a double layer need in addition, so that the trapezoidal rule is exact to the
/// tolerance. They fall with the cube of the distance, other kernels more slowly.
const STEEPER: f64 = 1.0;

/// Thinnest film between a rigid body and a wall in squared distances of nodes times the curvature of the body there:
/// with fewer nodes in the width of the film, sqrt(2 film/curvature), the speed at which it drains is off by more than
/// 1 %. Measured for a disc with 48 to 512 nodes, whose error is at most 0.65 % there.
const FILM: f64 = 2.3;
/// Gap over the radius of curvature above which the flow between body and wall is no longer a lubrication flow.
const WIDEST_FILM: f64 = 0.3;

/// Returns the nodes in place of each node so that the image of a curve, which is two gaps away, is summed to the
/// tolerance. It is one below which all are within the `reach` (length) of each other. Next to a rigid body, what is
/// left of the forces on it as the film closes is far smaller than the forces on the two sides. Sums must therefore be
/// right to the tolerance.
fn factor(reach: f64, gap: f64) -> usize {
    let needed = (reach / (2.0 * gap)).min(MOST_NODES as f64).ceil() as usize;
    needed.next_power_of_two().max(REFINEMENT)
}

/// Returns the smallest distance of a curve from the walls (length), by its samples and what is known.
fn narrowest(curve: &Curve, half: f64, known: f64) -> f64 {
    let samples = curve.wall_samples(true).position.iter();
    let gap = samples.map(|z| half - (z.im + curve.centre.im).abs()).fold(known, f64::min);
    gap.max(LEAST_GAP * curve.spacing())
}

/// The walls of a channel with the nodes of the curves between them.
#[derive(Debug, Clone)]
pub(crate) struct Walls {
    length: f64,
    half: f64,
    pub(crate) drive: Drive,
    /// Walls along which fluid slips; `None` for no slip at both.
    slipping: Option<Slipping>,
    tolerance: f64,
    modes: WallModes,
    nodes: WallPoints,
    /// Curve and number of each node.
    owners: Vec<[usize; 2]>,
    /// Sources where some are taken from the fine nodes, and the curve and the number of each; empty otherwise.
    sources: WallPoints,
    source_owners: Vec<[usize; 2]>,
    /// True for curves with a gap to a wall so narrow that sources are taken from their fine nodes.
    refined: Vec<bool>,
    /// Smallest distance of a node of each curve from a wall, and of all of them (length).
    gaps: Vec<f64>,
    gap: f64,
    /// Points off the curves.
    points: WallPoints,
    /// Images in closed form, and whether they replace most of the modes for the present shapes.
    pub(super) images: WallImages,
    images_used: bool,
    /// Flow of the modes at the nodes.
    flow: Vec<[f64; 2]>,
}

impl Walls {
    /// Walls of a channel with slip lengths of the lower and the upper one.
    pub(crate) fn new(length: f64, width: f64, drive: Drive, slip: [f64; 2], tolerance: f64) -> Self {
        let half = 0.5 * width;
        let slipping = Slipping::new(half, slip);
        let points = WallPoints::new(length, half);
        Self {
            length,
            half,
            drive,
            slipping,
            tolerance,
            modes: WallModes::new(length, half, drive.flux().is_some()).with_slip(slipping),
            nodes: points.clone(),
            owners: Vec::new(),
            sources: points.clone(),
            source_owners: Vec::new(),
            refined: Vec::new(),
            gaps: Vec::new(),
            gap: 0.0,
            flow: Vec::new(),
            points,
            images: WallImages::new(length, half),
            images_used: false,
        }
    }

    /// Returns true if some sources are taken from fine nodes.
    pub(crate) fn is_refined(&self) -> bool {
        !self.images_used && self.refined.contains(&true)
    }

    /// Returns true for a curve whose sources are taken from the fine nodes, so that forces and velocities are needed
    /// there.
    pub(crate) fn refines(&self, curve: usize) -> bool {
        self.refined.get(curve).is_some_and(|refined| *refined)
    }

    /// Forgets how the images of earlier shapes were summed.
    pub(crate) fn clear(&mut self) {
        self.images_used = false;
    }

    /// Takes over the present shapes. Images are summed in closed form if `closed`, and if curves are so close to a
    /// wall that modes would cost more.
    ///
    /// # Errors
    /// Returns an error for a node beyond a wall.
    pub(crate) fn load(&mut self, curves: &mut [Curve], plans: &mut Plans, closed: bool) -> Result<(), LayerError> {
        self.nodes.clear();
        self.owners.clear();
        self.refined.clear();
        self.gaps.clear();
        for (number, curve) in curves.iter().enumerate() {
            let mut least = f64::INFINITY;
            for (node, z) in curve.nodes.position.iter().enumerate() {
                let z = z + curve.centre;
                let depth = z.im.abs() - self.half;
                let allowed = ROUND_OFF * self.half;
                if depth > allowed {
                    return Err(LayerError::BeyondWall { curve: number, node, x: z.re, y: z.im, depth, allowed });
                }
                let y = z.im.clamp(-self.half, self.half);
                least = least.min(self.half - y.abs());
                self.owners.push([number, node]);
                self.nodes.push(z.re, y);
            }
            // The image of a node behind the wall is two gaps away from the node.
            self.refined.push(2.0 * least < reach(self.tolerance) * curve.spacing());
            self.gaps.push(least);
        }
        let half = self.half;
        self.each_refined(curves, plans, |curve, transforms, gap| {
            curve.refine(transforms);
            *gap = narrowest(curve, half, *gap);
            Ok(())
        })?;
        self.nodes.prepare();
        if closed && self.images_pay(curves) {
            self.use_images(curves, plans);
            return Ok(());
        }
        Ok(self.use_modes(curves, plans)?)
    }

    /// Sums the images of the present shapes in closed form.
    pub(crate) fn use_images(&mut self, curves: &mut [Curve], plans: &mut Plans) {
        self.images_used = true;
        self.images.load(curves, STEEPER + reach(self.tolerance));
        for source in self.images.sources() {
            let curve = &mut curves[source];
            curve.refine(&mut plans[curve.plan].transforms);
        }
        self.sources.clear();
        self.source_owners.clear();
    }

    /// Calls `work` with each curve that has a narrow gap, its transforms and the gap.
    fn each_refined(
        &mut self,
        curves: &mut [Curve],
        plans: &mut Plans,
        work: impl Fn(&mut Curve, &mut Transforms, &mut f64) -> Result<(), InputError> + Sync + Send,
    ) -> Result<(), InputError> {
        let nodes = self.owners.len();
        let len = shares::curves(curves.len(), nodes);
        let near = self.refined.chunks(len).zip(self.gaps.chunks_mut(len));
        let mut results = array::from_fn::<_, { shares::MOST }, _>(|_| Ok(()));
        let pieces = curves.chunks_mut(len).zip(plans.pieces()).zip(near).zip(&mut results);
        shares::each_of(nodes, pieces, |(((curves, plans), (refined, gaps)), result)| {
            let mut all = curves.iter_mut().zip(*refined).zip(&mut **gaps).filter(|((_, refined), _)| **refined);
            **result = all.try_for_each(|((curve, _), gap)| {
                let transforms = &mut plans[curve.plan].transforms;
                work(curve, transforms, gap)
            });
        });
        self.gap = self.gaps.iter().copied().fold(f64::INFINITY, f64::min);
        results.into_iter().collect()
    }

    /// Sums the images of the present shapes by modes, over as many fine nodes as the gaps need.
    pub(crate) fn use_modes(&mut self, curves: &mut [Curve], plans: &mut Plans) -> Result<(), InputError> {
        self.images_used = false;
        let (half, reach) = (self.half, reach(self.tolerance));
        self.each_refined(curves, plans, |curve, transforms, gap| {
            curve.refine_for_walls(transforms, factor(reach * curve.spacing(), *gap))?;
            *gap = narrowest(curve, half, *gap);
            Ok(())
        })?;
        self.load_sources(curves, |refined, number| refined[number]);
        Ok(())
    }

    /// Returns true if the images of narrow gaps are summed in closed form for the present shapes.
    pub(crate) fn uses_images(&self) -> bool {
        self.images_used
    }

    /// Returns the number of modes of the last sum.
    #[cfg(test)]
    pub(crate) fn mode_count(&self) -> usize {
        self.modes.count_now()
    }

    /// Returns true if sums of images in closed form cost less than modes, in a channel whose width the nodes resolve.
    fn images_pay(&self, curves: &[Curve]) -> bool {
        let (reach, nodes) = (reach(self.tolerance), self.owners.len());
        if self.slipping.is_some() || nodes > MOST_IMAGES || !self.refined.contains(&true) {
            return false;
        }
        let longest = (2.5 - self.tolerance.ln()) * self.length / TAU;
        let (mut by_modes, mut by_images) = (0.0, PAIR * (nodes * nodes) as f64);
        for ((curve, refined), gap) in curves.iter().zip(&self.refined).zip(&self.gaps) {
            let spacing = curve.spacing();
            if reach * spacing > 2.0 * self.half || *gap <= LEAST_GAP * spacing {
                return false;
            }
            let factor = if *refined { factor(reach * spacing, *gap) as f64 } else { 1.0 };
            for z in &curve.nodes.position {
                for depth in [self.half - (z.im + curve.centre.im), self.half + (z.im + curve.centre.im)] {
                    by_modes += factor * longest / (depth + self.gap);
                    if *refined && 2.0 * depth < reach * spacing {
                        by_images += CLOSE * curve.len() as f64;
                    }
                }
            }
        }
        by_images < by_modes
    }

    /// Refuses a film between a wall and a rigid body that the nodes of the body do not resolve.
    pub(crate) fn check_film(&self, number: usize, curve: &Curve) -> Result<(), LayerError> {
        let [gap, nodes] = [self.gaps[number], curve.len() as f64];
        let height = |node: &usize| (curve.nodes.position[*node].im + curve.centre.im).abs();
        let nearest = (0..curve.len()).max_by(|a, b| height(a).total_cmp(&height(b))).unwrap_or_default();
        let curvature = curve.curvature[nearest];
        let least = (FILM * curve.spacing().powi(2) * curvature).min(WIDEST_FILM / curvature);
        if curvature <= 0.0 || gap >= least {
            return Ok(());
        }
        let needed = (nodes * (least / gap).sqrt()).ceil() as usize;
        Err(LayerError::NarrowGap { curve: number, gap, least, nodes: curve.len(), needed })
    }

    /// Takes over the sources, if the sources of some curve are its fine nodes.
    fn load_sources(&mut self, curves: &[Curve], fine: impl Fn(&[bool], usize) -> bool) {
        self.sources.clear();
        self.source_owners.clear();
        if !(0..curves.len()).any(|number| fine(&self.refined, number)) {
            return;
        }
        for (number, curve) in curves.iter().enumerate() {
            for (node, z) in curve.wall_samples(fine(&self.refined, number)).position.iter().enumerate() {
                let z = z + curve.centre;
                self.sources.push(z.re, z.im);
                self.source_owners.push([number, node]);
            }
        }
        self.sources.prepare();
    }

    /// Returns the sources with curve and number of each, and the mode sums.
    fn sources(&mut self) -> (&WallPoints, &[[usize; 2]], &mut WallModes) {
        if self.source_owners.is_empty() {
            (&self.nodes, &self.owners, &mut self.modes)
        } else {
            (&self.sources, &self.source_owners, &mut self.modes)
        }
    }

    /// Adds the forces at the sources of some curves to the modes; `fine` is true for curves whose sources are their
    /// fine nodes.
    fn put_forces(
        &mut self,
        curves: &[Curve],
        from: Range<usize>,
        fine: impl Fn(&[bool], usize) -> bool + Sync,
        target_gap: f64,
    ) {
        let refined = std::mem::take(&mut self.refined);
        let (points, owners, modes) = self.sources();
        let force = |j: usize| {
            let [curve, i] = owners[j];
            let samples = || curves[curve].wall_samples(fine(&refined, curve));
            if from.contains(&curve) { samples().force[i] } else { Complex64::default() }
        };
        modes.add_forces(points, target_gap, force);
        self.refined = refined;
    }

    /// Adds `sign` times the dipoles at the sources to the modes, `values` being the velocities at the fine nodes of
    /// all curves, where they are needed.
    fn put_dipoles(
        &mut self,
        curves: &[Curve],
        density: Density<'_>,
        values: &[Complex64],
        fine: impl Fn(&[bool], usize) -> bool + Sync,
        (target_gap, sign): (f64, f64),
    ) {
        let refined = std::mem::take(&mut self.refined);
        let (points, owners, modes) = self.sources();
        let dipole = |j: usize| {
            let [curve, i] = owners[j];
            let contrast = density.contrast(curve);
            if contrast == 0.0 {
                return [0.0; 3];
            }
            let fine = fine(&refined, curve);
            let v = if fine {
                let len = REFINEMENT * density.nodes();
                curves[curve].wall_density(&values[len * curve..len * (curve + 1)])[i]
            } else {
                let (x, y) = density.of(curve);
                Complex64::new(x[i], y[i])
            };
            let samples = curves[curve].wall_samples(fine);
            let weight = sign * TAU / samples.position.len() as f64;
            let t = samples.tangent[i] * (contrast * weight);
            [v.re * t.im, v.im * t.im - v.re * t.re, -v.im * t.re]
        };
        let x = |j: usize| {
            let [curve, i] = owners[j];
            curves[curve].wall_samples(fine(&refined, curve)).position[i].re
        };
        modes.add_dipoles(points, target_gap, dipole, x);
        self.refined = refined;
    }

    /// Adds the flow of the modes at the nodes.
    fn add_modes(&mut self, out: &mut [Vectors]) {
        self.modes.solve();
        self.modes.velocities(&self.nodes, &mut self.flow);
        for ([curve, i], [u, v]) in self.owners.iter().zip(&self.flow) {
            out[*curve].x[*i] += u;
            out[*curve].y[*i] += v;
        }
    }

    /// Adds the contribution of the walls to the single layer of some curves.
    pub(crate) fn add_forces(
        &mut self,
        curves: &[Curve],
        from: Range<usize>,
        uncorrected: Uncorrected,
        plans: &mut [Plan],
        out: &mut [Vectors],
    ) {
        if self.images_used {
            self.modes.begin(Uncorrected::Images, self.half, self.half, self.tolerance);
            self.put_forces(curves, from, |_, _| false, self.half);
            self.images.add_forces(curves, plans, STEEPER + reach(self.tolerance), out);
            self.add_modes(out);
        } else if !curves.is_empty() {
            self.modes.begin(uncorrected, self.gap, self.gap, self.tolerance);
            self.put_forces(curves, from, |refined, curve| refined[curve], self.gap);
            self.add_modes(out);
        }
    }

    /// Adds the contribution of the walls to the double layer; `fine` has the velocities at the fine nodes where they
    /// are needed.
    pub(crate) fn add_dipoles(
        &mut self,
        curves: &[Curve],
        density: Density<'_>,
        fine: &[Complex64],
        (uncorrected, accuracy): (Uncorrected, f64),
        plans: &mut [Plan],
        out: &mut [Vectors],
    ) {
        if self.images_used {
            self.modes.begin(Uncorrected::Images, self.half, self.half, accuracy);
            self.put_dipoles(curves, density, fine, |_, _| false, (self.half, 1.0));
            self.images.add_dipoles(curves, plans, STEEPER + reach(self.tolerance), density, out);
            self.add_modes(out);
            return;
        }
        self.modes.begin(uncorrected, self.gap, self.gap, accuracy);
        self.put_dipoles(curves, density, fine, |refined, curve| refined[curve], (self.gap, 1.0));
        self.add_modes(out);
    }

    /// Returns the Couette flow of walls that slide, the lower and the upper one faster by these factors.
    pub(crate) fn sliding(&self, imposed: &ImposedFlow, factors: [f64; 2]) -> ImposedFlow {
        let at = |wall: usize, y: f64| factors[wall] * imposed.velocity_at(Vec2::new(0.0, y)).x;
        let width = 2.0 * self.half;
        match self.slipping {
            None => ImposedFlow::couette([at(0, -self.half), at(1, self.half)], width),
            // The flow has the velocity of a wall at the slip length behind it.
            Some(Slipping { ends: [a, b], lengths: [upper, lower], .. }) => {
                ImposedFlow::couette_with_slip([at(0, -b), at(1, a)], width, [lower, upper])
            }
        }
    }

    /// Returns the parabolic flow that the drive drives besides an imposed one.
    pub(crate) fn driven_flow(&self, imposed: &ImposedFlow, viscosity: f64) -> ImposedFlow {
        let h = self.half;
        let factor = match self.drive.flux() {
            None => -self.drive.gradient() / (2.0 * viscosity),
            Some(flux) => match self.slipping {
                None => 0.75 * (flux - self.flux(imposed)) / (h * h * h),
                Some(slipping) => (flux - self.flux(imposed)) / slipping.flux(),
            },
        };
        let parabola = ImposedFlow { velocity: [factor * (h * h), 0.0], bend: -2.0 * factor, ..ImposedFlow::NONE };
        self.slipping.map_or(parabola, |Slipping { profile: [constant, slope], .. }| {
            let along = ImposedFlow { velocity: [factor * constant, 0.0], ..ImposedFlow::shear(factor * slope) };
            parabola + along
        })
    }

    /// Returns one over the flux of the profile h^2 - y^2, or of that with slip (1/length cubed).
    fn per_flux(&self) -> f64 {
        self.slipping.map_or(0.75 / (self.half * self.half * self.half), |slipping| 1.0 / slipping.flux())
    }

    /// Returns the flux of the imposed flow through the channel (area per time), which walls that slide have.
    fn flux(&self, imposed: &ImposedFlow) -> f64 {
        2.0 * self.half * imposed.velocity[0]
    }

    /// Returns the mean pressure gradient along x (stress per length).
    pub(crate) fn pressure_gradient(
        &self,
        curves: &[Curve],
        density: Density<'_>,
        imposed: &ImposedFlow,
        viscosity: f64,
    ) -> f64 {
        let Some(flux) = self.drive.flux() else { return self.drive.gradient() };
        let sum = self.force_moment(curves) - self.dipole_moment(curves, density);
        2.0 * self.per_flux() * (sum / (2.0 * self.length) - viscosity * (flux - self.flux(imposed)))
    }

    /// Returns the sum of (h^2 - y^2) F_x, or of the profile with slip (force times area): 2 l eta times the flux of
    /// the forces at zero mean pressure gradient.
    pub(crate) fn force_moment(&self, curves: &[Curve]) -> f64 {
        let [constant, slope] = self.slipping.map_or([0.0; 2], |slipping| slipping.profile);
        let parabola = |y: f64| self.half * self.half - y * y + (constant + slope * y);
        let nodes = |curve: &Curve| -> f64 {
            let terms = curve.nodes.position.iter().zip(&curve.nodes.force);
            terms.map(|(z, force)| parabola(z.im + curve.centre.im) * force.re).sum()
        };
        curves.iter().map(nodes).sum()
    }

    /// Returns the moment of the double layer, `-2 sum [y (v_x n_y + v_y n_x) - x v.n]`, with the slope of the profile
    /// with slip in place of -2 y: 2 l eta times its flux.
    pub(crate) fn dipole_moment(&self, curves: &[Curve], density: Density<'_>) -> f64 {
        let mut sum = 0.0;
        let middle = self.slipping.map_or(0.0, |slipping| 0.5 * slipping.profile[1]);
        for (index, (curve, contrast)) in curves.iter().zip(density.contrasts).enumerate() {
            let (vx, vy) = density.of(index);
            let contrast = contrast * curve.weight();
            for (i, (z, t)) in curve.nodes.position.iter().zip(&curve.nodes.tangent).enumerate() {
                let y = z.im + curve.centre.im;
                let (nx, ny) = (t.im * contrast, -t.re * contrast);
                let shear = vx[i] * ny + vy[i] * nx;
                let flux = vx[i] * nx + vy[i] * ny;
                sum -= 2.0 * ((y - middle) * shear - z.re * flux);
            }
        }
        sum
    }

    /// Prepares for [`Walls::add_flow`] at these points, with velocities at the fine nodes, to `sharper` times the
    /// tolerance.
    pub(crate) fn prepare_points(
        &mut self,
        curves: &[Curve],
        density: Density<'_>,
        fine: &[Complex64],
        (uncorrected, sharper): (Uncorrected, f64),
        points: impl Iterator<Item = Complex64>,
    ) {
        self.points.clear();
        for z in points {
            self.points.push(z.re, z.im.clamp(-self.half, self.half));
        }
        self.points.prepare();
        self.load_sources(curves, |_, _| true);
        if curves.is_empty() {
            self.modes.begin(Uncorrected::Row, self.half, self.half, self.tolerance);
        } else {
            let spacing = curves.iter().map(Curve::spacing).fold(0.0, f64::max);
            let source_gap = self.sources.gap().max(LEAST_GAP * spacing);
            let target_gap = self.points.gap().min(self.half);
            self.modes.begin(uncorrected, source_gap, target_gap, sharper * self.tolerance);
            self.put_forces(curves, 0..curves.len(), |_, _| true, target_gap);
            if !density.vanishes() {
                self.put_dipoles(curves, density, fine, |_, _| true, (target_gap, -1.0));
            }
        }
        self.modes.solve();
        let images = self.images_used;
        self.load_sources(curves, |refined, number| refined[number] && !images);
    }

    /// Adds the contribution of the walls to the flow at the point of that number.
    pub(crate) fn add_flow(&self, index: usize, flow: &mut Flow) {
        *flow += self.modes.flow(&self.points, index);
    }
}
