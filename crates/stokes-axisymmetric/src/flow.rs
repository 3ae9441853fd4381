//! Axisymmetric Stokes flow of interfaces and rigid bodies, alone or in a container.

mod calculus;
mod container;
mod disturbance;
mod fine;
mod fixed_panels;
mod meridian;
mod panels;
mod ring;
mod spot;
mod truncation;
mod waves;

use std::{collections::HashMap, f64::consts::PI, ops::Range};

use motile_base::{Drive, FlowSample, Region, Vec2, positive, same_length, within};
use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::refusal::{in_two_dimensions, meets_axis, not_axisymmetric, singular_surfaces};
use stokes_boundary_integrals::{
    Inside, Interface, LayerError, Settings, Solution,
    internal::{MOST_CONTRAST, MOST_POINTS, MOST_SHARES, each_share, finite_vectors},
};

pub use calculus::MeridianCalculus;
pub use container::tube;
use container::{Tube, Walls};
pub use disturbance::Disturbances;
use fine::Levels;
use meridian::{Grid, Half, Meridian};
use panels::{Panels, Spot};
use ring::Wanted;
use waves::Pair;

/// Distance over the size of a surface within which a point is taken for one on its outside.
const CLOSEST: f64 = 1e-9;
/// Distance over the size by which points may differ from the mirror image of one another.
const ASYMMETRY: f64 = 1e-6;
/// Points that finer nodes are made for, rather than panels for each of them.
const MANY: usize = 100;
/// Largest difference of a point from the mirror image of another one, over the extent of all, that is round-off.
const MIRRORED: f64 = 1e-14;
/// Most nodes of a closed curve: the matrix for a viscosity contrast then takes 36 MB.
const MOST_NODES: f64 = 2048.0;

/// Viscosities or rigidity of a surface, as they enter the equation times 8 pi.
#[derive(Debug, Clone, Copy)]
struct Sides {
    /// Viscosity inside (stress times time); `None` for a rigid body.
    inside: Option<f64>,
    outside: f64,
}

impl Sides {
    /// Returns the factor of the unknown at its own surface.
    fn mean(&self) -> f64 {
        self.inside.map_or(0.5, |inside| 0.5 * (inside + self.outside))
    }

    /// Layers that the surface has.
    fn wanted(&self) -> Wanted {
        if self.contrast() == 0.0 { Wanted::Single } else { Wanted::Both }
    }

    /// Returns the factor of the double layer of the unknown.
    fn contrast(&self) -> f64 {
        self.inside.map_or(-1.0, |inside| self.outside - inside)
    }
}

/// Stokes flow in three dimensions of surfaces of revolution about the x axis, without swirl: velocities on interfaces
/// and rigid bodies from the forces on them.
///
/// A surface is given as in the plane, [`Interface`], by the closed curve of its meridian and the mirror image of that.
/// It has an even number n of points, counter-clockwise, point 0 where x is largest on the axis, point n - k the mirror
/// image of point k. The force at a point is that on half of its ring (on all of it at the poles): its component along
/// x, summed over all points, is the force on the surface. Velocities are mirror images too.
///
/// With the meridian X(t), t from 0 to pi, the force g per t and azimuth, the velocity on an interface solves
///
/// ```text
/// (eta_in + eta_ext)/2 u - (eta_ext - eta_in)/(8 pi) INT T(u) n r |X_t| dt = 1/(8 pi) INT G g dt
/// ```
///
/// (Pozrikidis, Boundary Integral and Singularity Methods, 1992, section 2.4) with Stokeslet and stress integrated over
/// the azimuth: complete elliptic integrals. A rigid body is the limit of eta_in to infinity
/// ([`InterfaceFlow`](stokes_boundary_integrals::InterfaceFlow)). Shapes, forces and velocities are series of sines and
/// cosines in t with `nodes/2` waves. A target on a surface or close to it is integrated over panels that double away
/// from it, one far away by weights that are exact for sines. Errors fall faster than any power of the number of nodes
/// at any distance from the axis and between surfaces. The equation, of `nodes` unknowns a surface, is solved by
/// elimination.
///
/// ```
/// use motile_base::Vec2;
/// use stokes_axisymmetric::{AxisymmetricFlow, Interface, LayerError, Settings};
///
/// // A rigid sphere pulled by a force of 6 pi along the axis through fluid of viscosity 1 moves at a speed of 1.
/// let count = 64;
/// let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
/// let sphere: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(angle(k))).collect();
/// // The force on a ring goes with its circumference.
/// let share: f64 = (0..count).map(|k| angle(k).sin().abs()).sum();
/// let pull = |k: usize| Vec2::new(6.0 * std::f64::consts::PI * angle(k).sin().abs() / share, 0.0);
/// let forces: Vec<Vec2> = (0..count).map(pull).collect();
///
/// let mut flow = AxisymmetricFlow::new(1.0, Settings::default())?;
/// flow.load([Interface::rigid(&sphere, &forces, 1.0)].into_iter())?;
/// flow.solve()?;
/// println!("speed {:.4}", flow.rigid_velocity(0).unwrap_or(f64::NAN));
/// assert!((flow.rigid_velocity(0).unwrap() - 1.0).abs() < 1e-3); // as good as the sum over the points
/// # Ok::<(), LayerError>(())
/// ```
#[derive(Debug, Clone)]
pub struct AxisymmetricFlow {
    viscosity: f64,
    settings: Settings,
    grid: Grid,
    panels: Panels,
    halves: Vec<Half>,
    surfaces: Vec<Meridian>,
    sides: Vec<Sides>,
    walls: Option<Box<Walls>>,
    tube: Option<Tube>,
    /// Drive of a tube and the length that it is given for (length), infinite for one alone.
    drive: (Drive, f64),
    /// Flux through a tube (volume per time).
    flux: f64,
    /// Unknown of each surface, cosines of x and sines of r: its velocity (length per time), or of a rigid body the
    /// density of its double layer (length per time times viscosity).
    solution: Vec<Pair>,
    /// 8 pi times viscosity times velocity of the single layers at the nodes, x then r, surface after surface.
    right: DVector<f64>,
    matrix: DMatrix<f64>,
    /// Its rows, and the right-hand side, node by node.
    rows: Vec<f64>,
    sums: Vec<Vec2>,
    /// Working memory of the shares of the nodes.
    shares: Vec<Panels>,
}

impl AxisymmetricFlow {
    /// Creates the flow in unbounded fluid of this viscosity (stress times time), without surfaces. `settings.nodes`
    /// counts the nodes of the closed curve, an even number; of the others only these count here, since nothing is
    /// truncated.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is not positive and finite, settings out of their range, more than 2048
    /// nodes.
    pub fn new(viscosity: f64, settings: Settings) -> Result<Self, LayerError> {
        positive("the viscosity", viscosity)?;
        settings.check()?;
        within("the number of nodes of a surface of revolution", settings.nodes as f64, 16.0, MOST_NODES)?;
        let nodes = settings.nodes / 2;
        Ok(Self {
            viscosity,
            settings,
            grid: Grid::new(nodes),
            panels: Panels::new(nodes),
            halves: Vec::new(),
            surfaces: Vec::new(),
            sides: Vec::new(),
            walls: None,
            tube: None,
            drive: (Drive::ZeroFlux, f64::INFINITY),
            flux: 0.0,
            solution: Vec::new(),
            right: DVector::zeros(0),
            matrix: DMatrix::zeros(0, 0),
            rows: Vec::new(),
            sums: Vec::new(),
            shares: Vec::new(),
        })
    }

    /// Adds a rigid container at rest around all surfaces, given as they are ([`tube`] gives tubes), with
    /// `nodes` nodes of its closed curve, in place of one that there was. The forces f on it cancel the velocity on it,
    ///
    /// ```text
    /// INT G f dt  +  layers of the surfaces  =  0    on the wall;
    /// ```
    ///
    /// the matrix of this equation is factorised here, once. The flux through any section is zero.
    ///
    /// # Errors
    /// Returns an error for points that are not a meridian with its mirror image; fewer than 16 nodes, more than 2048
    /// or than points.
    pub fn with_container(mut self, points: &[Vec2], nodes: usize) -> Result<Self, LayerError> {
        self.contain(points, nodes)?;
        self.tube = None;
        Ok(self)
    }

    fn contain(&mut self, points: &[Vec2], nodes: usize) -> Result<(), LayerError> {
        within("the number of nodes of a container", nodes as f64, 16.0, MOST_NODES)?;
        let grid = Grid::new(nodes / 2);
        let mut meridian = Meridian::new(&grid);
        load(&mut self.halves, &grid, &mut meridian, points, &[], 0)?;
        self.walls = Some(Box::new(Walls::new(grid, meridian)?));
        Ok(())
    }

    /// Puts the surfaces into an infinitely long straight tube of this radius (length), whose flux is zero. This is a
    /// closed tube that moves with them, 5.5 radii longer than they are at both ends, since flows decay like exp(-4.47
    /// x/radius) along it. Its nodes follow from the gap to the surfaces; it is rebuilt and factorised again when they
    /// come closer.
    ///
    /// # Errors
    /// Returns an error for a radius that is not positive and finite.
    pub fn with_tube(mut self, radius: f64) -> Result<Self, LayerError> {
        self.tube = Some(Tube::new(positive("the radius of a tube", radius)?));
        self.walls = None;
        Ok(self)
    }

    /// Creates the flow in space or in a tube, straight or of another shape.
    ///
    /// # Errors
    /// Returns an error for a region of the plane; the errors of [`AxisymmetricFlow::new`],
    /// [`AxisymmetricFlow::with_tube`] and [`AxisymmetricFlow::with_drive`].
    pub fn in_region(region: Region, viscosity: f64, settings: Settings) -> Result<Self, LayerError> {
        region.check()?;
        let mut flow = Self::new(viscosity, settings)?;
        match region {
            Region::Space => Ok(flow),
            Region::Tube { radius, shape, drive, length } => {
                let Some(half_length) = region.half_length() else {
                    return flow.with_tube(radius)?.with_drive(drive, length.unwrap_or(f64::INFINITY));
                };
                let [wall, count] = container::nodes_of(shape, radius, half_length);
                flow.contain(&tube(|x| shape.radius(radius, half_length, x), half_length, wall)?, count)?;
                if let Some(walls) = &mut flow.walls {
                    walls.open(viscosity, radius, half_length);
                }
                flow.with_drive(drive, f64::INFINITY)
            }
            _ => Err(in_two_dimensions()),
        }
    }

    /// Drives fluid through the tube: a flux (volume per time), or a mean pressure gradient (stress per length) over a
    /// length (length) of a straight one, as in a tube with these surfaces in every such length, of whose flow on one
    /// another only the pressure counts. The mean velocity of a flux Q is `Q/(pi R^2)`.
    ///
    /// In a straight tube the surfaces are in the flow of Poiseuille, and the flow that they cause has no flux. By the
    /// reciprocal theorem the pressure rises along the tube through forces f on the fluid and velocities u on surfaces
    /// of another viscosity, with the flow U of Poiseuille of the flux 1, by
    ///
    /// ```text
    /// INT f_x U dS + (eta_ext - eta_in) INT (u_x n_r + u_r n_x) dU/dr + 8 x/(pi R^4) u.n dS
    /// ```
    ///
    /// # Errors
    /// Returns an error if there is no tube around the surfaces, or for a pressure gradient in one that is not
    /// straight, numbers that are not finite.
    pub fn with_drive(mut self, drive: Drive, length: f64) -> Result<Self, LayerError> {
        drive.check()?;
        let open = self.tube.is_some() || self.walls.as_ref().is_some_and(|walls| walls.open.is_some());
        if !open && drive != Drive::ZeroFlux {
            return Err(LayerError::no_such_flow("a flux through a closed region", "Use a tube, or zero flux"));
        }
        if self.tube.is_none() && drive.flux().is_none() {
            let (flow, remedy) = ("a pressure gradient in a tube that is not straight", "Prescribe the flux instead");
            return Err(LayerError::no_such_flow(flow, remedy));
        }
        self.drive = (drive, length);
        Ok(self)
    }

    /// Returns the flux through the tube (volume per time) in the last solution.
    #[must_use]
    pub fn flux(&self) -> f64 {
        self.flux
    }

    /// Returns the mean pressure gradient (stress per length) over the length that the drive of a straight tube is
    /// given for; `None` if there is no straight tube.
    #[must_use]
    pub fn pressure_gradient(&self) -> Option<f64> {
        let Tube { radius, .. } = self.tube.as_ref()?;
        let rise = if self.drive.1.is_finite() { self.pressure_rise(true) / self.drive.1 } else { 0.0 };
        Some(rise - container::resistance(*radius, self.viscosity) * self.flux)
    }

    /// Returns the viscosity of the exterior fluid (stress times time).
    #[must_use]
    pub fn viscosity(&self) -> f64 {
        self.viscosity
    }

    /// Returns the resolution.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns the number of surfaces.
    #[must_use]
    pub fn len(&self) -> usize {
        self.surfaces.len()
    }

    /// Returns true without surfaces.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.surfaces.is_empty()
    }

    /// Returns the volume inside a surface (length cubed) and its area (length squared); `None` if there is no such
    /// surface.
    #[must_use]
    pub fn measures(&self, surface: usize) -> Option<[f64; 2]> {
        self.surfaces.get(surface).map(|meridian| meridian.measures(&self.grid))
    }

    /// Takes over surfaces, truncated to the waves that the nodes carry.
    ///
    /// # Errors
    /// Returns an error for:
    /// * a viscosity that is not positive and finite, or more than 1e8 times larger or smaller than the exterior one,
    /// * positions or forces that are not finite, an odd number of points or too few, points that are not the mirror
    ///   image of one another or cross the axis, a clockwise curve, a node beyond the container.
    pub fn load<'a>(&mut self, surfaces: impl Iterator<Item = Interface<'a>>) -> Result<(), LayerError> {
        let mut count = 0;
        self.sides.clear();
        for Interface { positions, forces, inside, viscosity_outside: outside, .. } in surfaces {
            let inside = if let Inside::Fluid { viscosity } = inside { Some(viscosity) } else { None };
            for (what, viscosity) in [
                ("the viscosity inside an interface", inside.unwrap_or(outside)),
                ("the viscosity outside an interface", outside),
            ] {
                let ratio = positive(what, viscosity)? / self.viscosity;
                within("the ratio of viscosities to the exterior one", ratio, 1.0 / MOST_CONTRAST, MOST_CONTRAST)?;
            }
            if self.surfaces.len() == count {
                self.surfaces.push(Meridian::new(&self.grid));
                self.solution.push(Pair::new(self.grid.largest() + 1));
            }
            load(&mut self.halves, &self.grid, &mut self.surfaces[count], positions, forces, count)?;
            self.sides.push(Sides { inside, outside });
            count += 1;
        }
        self.surfaces.truncate(count);
        self.solution.truncate(count);
        self.fit_walls()
    }

    /// Returns true if the equation needs a matrix.
    fn has_contrast(&self) -> bool {
        self.sides.iter().any(|sides| sides.contrast() != 0.0)
    }

    /// Solves for the velocities on the surfaces.
    ///
    /// # Errors
    /// Returns an error for equations that are singular to round-off, as where surfaces touch.
    pub fn solve(&mut self) -> Result<Solution, LayerError> {
        let n = 2 * self.grid.nodes;
        let count = n * self.len();
        if self.right.len() != count {
            self.right = DVector::zeros(count);
        }
        let with_matrix = self.has_contrast();
        let size = if with_matrix { count } else { 0 };
        if self.matrix.nrows() != size {
            self.matrix = DMatrix::zeros(size, size);
        }
        self.add_pairs();
        self.add_walls();
        let factors = with_matrix.then(|| {
            for surface in 0..self.len() {
                self.grid.add_values(8.0 * PI * self.sides[surface].mean(), &mut self.matrix, n * surface);
                self.complete(surface);
            }
            std::mem::replace(&mut self.matrix, DMatrix::zeros(0, 0)).lu()
        });
        let background = self.background();
        self.flux = self.drive.0.flux().unwrap_or(0.0);
        if let Some(background) = &background {
            self.right.axpy(self.flux, background, 1.0);
        }
        let mut right = std::mem::replace(&mut self.right, DVector::zeros(0));
        self.settle(factors.as_ref(), &mut right)?;
        self.right = right;
        if let (Some(background), None) = (background, self.drive.0.flux()) {
            self.hold_pressure(factors.as_ref(), background)?;
        }
        self.settle_walls();
        Ok(Solution::default())
    }

    /// Takes over the solution for a right-hand side, with the factors of the matrix if there is one.
    fn settle(&mut self, factors: Option<&LU<f64, Dyn, Dyn>>, right: &mut DVector<f64>) -> Result<(), LayerError> {
        let n = 2 * self.grid.nodes;
        if let Some(factors) = factors {
            if !factors.solve_mut(right) || right.iter().any(|value| !value.is_finite()) {
                return Err(singular_surfaces());
            }
            for (solution, values) in self.solution.iter_mut().zip(right.as_slice().chunks_exact(n)) {
                let (x, r) = values.split_at(n / 2);
                solution.cos[..n / 2].copy_from_slice(x);
                solution.sin[1..=n / 2].copy_from_slice(r);
            }
        } else {
            let parts = self.solution.iter_mut().zip(right.as_mut_slice().chunks_exact_mut(n));
            for ((solution, values), sides) in parts.zip(&self.sides) {
                values.iter_mut().for_each(|value| *value /= 8.0 * PI * sides.mean());
                let (x, r) = values.split_at(n / 2);
                self.grid.analyse(x, r, solution);
            }
        }
        Ok(())
    }

    /// Fills the right-hand side and the matrix with the layers of all surfaces at all nodes, in shares of the nodes.
    fn add_pairs(&mut self) {
        let width = self.matrix.ncols();
        let Self { grid, panels, shares, surfaces, sides, right, matrix, rows, sums, .. } = self;
        let (n, all) = (grid.nodes, grid.nodes * surfaces.len());
        sums.resize(all, Vec2::ZERO);
        sums.fill(Vec2::ZERO);
        rows.resize(2 * width * all, 0.0);
        rows.fill(0.0);
        let length = all.div_ceil(MOST_SHARES).max(1);
        shares.resize_with(all.div_ceil(length), || panels.clone());
        let mut rest = &mut rows[..];
        let parts = shares.iter_mut().zip(sums.chunks_mut(length)).enumerate();
        let mut parts: Vec<_> = parts
            .map(|(share, (panels, sums))| {
                let (own, others) = std::mem::take(&mut rest).split_at_mut(2 * width * sums.len());
                rest = others;
                (share * length, panels, sums, own)
            })
            .collect();
        each_share(&mut parts, |(first, panels, sums, rows)| {
            for (i, sum) in sums.iter_mut().enumerate() {
                let (target, j) = ((*first + i) / n, (*first + i) % n);
                let rows = &mut rows[2 * width * i..2 * width * (i + 1)];
                for (source, (meridian, sides)) in surfaces.iter().zip(sides.iter()).enumerate() {
                    let place = surfaces[target].nodes[j].place;
                    let spot = if target == source {
                        Spot { place, foot: grid.parameters[j], offset: Vec2::ZERO, gap: 0.0 }
                    } else {
                        meridian.spot(grid, place, panels)
                    };
                    let own = 2 * n * source..2 * n * (source + 1);
                    add_pair((grid, meridian), sides, &spot, panels, sum, (rows, own));
                }
            }
        });
        for (k, sum) in sums.iter().enumerate() {
            let row = 2 * n * (k / n) + k % n;
            (right[row], right[row + n]) = (sum.x, sum.y);
            for column in 0..width {
                matrix[(row, column)] = rows[2 * width * k + column];
                matrix[(row + n, column)] = rows[2 * width * k + width + column];
            }
        }
    }

    /// Adds to the equation of a surface the mean velocity of a rigid body, or the flux through an interface, which is
    /// zero and makes the equation of an inside of little viscosity regular.
    fn complete(&mut self, surface: usize) {
        let Self { grid, surfaces, sides, matrix, .. } = self;
        let n = grid.nodes;
        let (meridian, start) = (&surfaces[surface], 2 * n * surface);
        if sides[surface].inside.is_none() {
            for k in 0..n {
                let mean = 8.0 * PI * meridian.mean(grid, grid.waves.iter().map(|waves| waves.cos[k]));
                for j in 0..n {
                    matrix[(start + j, start + k)] += mean;
                }
            }
            return;
        }
        let factor = 8.0 * PI * sides[surface].outside / meridian.measures(grid)[1] * 2.0 * PI;
        for k in 0..n {
            let mut flux = [0.0; 2];
            for ((point, weight), waves) in meridian.nodes.iter().zip(&grid.weights).zip(&grid.waves) {
                let normal = weight * point.place.y * point.normal();
                flux[0] += normal.x * waves.cos[k];
                flux[1] += normal.y * waves.sin[k + 1];
            }
            for (j, point) in meridian.nodes.iter().enumerate() {
                let normal = factor * point.normal().normalize();
                for (column, flux) in [k, n + k].into_iter().zip(flux) {
                    matrix[(start + j, start + column)] += normal.x * flux;
                    matrix[(start + n + j, start + column)] += normal.y * flux;
                }
            }
        }
    }

    /// Returns the velocity (length per time) of a rigid body in the last solution. It is `None` if there is no rigid
    /// body of that number.
    #[must_use]
    pub fn rigid_velocity(&self, surface: usize) -> Option<f64> {
        let sides = self.sides.get(surface).filter(|sides| sides.inside.is_none())?;
        let cos = &self.solution.get(surface)?.cos;
        let values = self.grid.waves.iter().map(|waves| waves::dot(cos, &waves.cos));
        Some(self.surfaces[surface].mean(&self.grid, values) / sides.outside)
    }

    /// Writes the velocities (length per time) of the last solution at the points of a surface.
    ///
    /// # Errors
    /// Returns an error if there is no such surface, or for another number of points, velocities that are not finite.
    pub fn velocities(&self, surface: usize, out: &mut [Vec2]) -> Result<(), LayerError> {
        let expected = self.surfaces.get(surface).map_or(0, |meridian| meridian.points);
        same_length("the velocities of a surface", expected, out.len())?;
        if let Some(velocity) = self.rigid_velocity(surface) {
            out.fill(Vec2::new(velocity, 0.0));
        } else if let Some(half) = self.halves.iter().find(|half| 2 * half.intervals() == expected) {
            let waves = self.grid.nodes.min(half.intervals()) + 1;
            for k in 0..=half.intervals() {
                let (x, r) = half.value(&self.solution[surface], waves, k);
                out[k] = Vec2::new(x, r);
                out[(expected - k) % expected] = Vec2::new(x, -r);
            }
            (out[0].y, out[expected / 2].y) = (0.0, 0.0);
        }
        finite_vectors("the velocity", surface, out)
    }

    /// Writes the flow at points anywhere (length; y is the distance from the axis, of either sign), at any distance
    /// from the surfaces, for the last solution: velocity, pressure, and the gradient in the meridian plane. The
    /// velocity gradient across it is the negative sum of its diagonal. Points on a surface are taken for points
    /// outside of it.
    ///
    /// # Errors
    /// Returns an error for points that are not finite, slices of different length.
    pub fn sample(&mut self, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), LayerError> {
        same_length("out", points.len(), out.len())?;
        finite_vectors("the position", 0, points)?;
        // Pictures of the meridian plane hold each point and, but for round-off, its mirror image.
        let mut known: HashMap<[u64; 2], (f64, FlowSample)> = HashMap::new();
        let extent = points.iter().map(|point| point.abs().max_element()).fold(f64::MIN_POSITIVE, f64::max);
        let layers = if points.len() < MANY { 0 } else { self.len() + 1 };
        let mut fine: Vec<Levels> = (0..layers).map(|_| Levels::default()).collect();
        for (point, out) in points.iter().zip(out) {
            let side = if point.y < 0.0 { -1.0 } else { 1.0 };
            let place = Vec2::new(point.x, point.y.abs());
            let key = [place.x.to_bits(), (place.y / (MIRRORED * extent)).round() as u64];
            *out = match known.get(&key) {
                Some((y, sample)) if y * side < 0.0 || *y == point.y => *sample,
                _ => self.flow_at(place, &mut fine),
            };
            known.entry(key).or_insert((point.y, *out));
            out.velocity.y *= side;
            (out.gradient[0][1], out.gradient[1][0]) = (side * out.gradient[0][1], side * out.gradient[1][0]);
        }
        Ok(())
    }

    /// Returns the flow at a point of the upper half plane, with finer nodes of the surfaces and the walls, or none.
    fn flow_at(&mut self, place: Vec2, fine: &mut [Levels]) -> FlowSample {
        let Self { grid, panels, surfaces, sides, solution, walls, viscosity, .. } = &mut *self;
        let viscosity = *viscosity;
        let mut fluid = (viscosity, f64::INFINITY);
        let mut sum = ([0.0; 2], 0.0, [[0.0; 2]; 2]);
        let mut add = |factor: f64, (u, p, g): ([f64; 2], f64, [[f64; 2]; 2])| {
            sum.0.iter_mut().zip(u).for_each(|(sum, u)| *sum += factor * u);
            sum.1 += factor * p;
            let gradient = sum.2.as_flattened_mut().iter_mut().zip(g.as_flattened());
            gradient.for_each(|(sum, g)| *sum += factor * g);
        };
        for (surface, meridian) in surfaces.iter().enumerate() {
            let (sides, solution) = (&sides[surface], &solution[surface]);
            let mut spot = meridian.spot(grid, place, panels);
            let size = meridian.spacing * grid.nodes as f64;
            if spot.gap < CLOSEST * size {
                panels.waves.fill(spot.foot);
                let point = meridian.at(&panels.waves);
                let away = CLOSEST * size * point.normal().normalize();
                let place = Vec2::new(point.place.x + away.x, (point.place.y + away.y).abs());
                spot = Spot { place, offset: -away, gap: away.length(), ..spot };
            }
            // The innermost surface around a point has the least volume.
            let volume = meridian.measures(grid)[0];
            if volume < fluid.1 && meridian.holds_spot(&spot, panels) {
                fluid = (sides.inside.unwrap_or(f64::INFINITY), volume);
            }
            let contrast = sides.contrast();
            let wanted = if contrast == 0.0 { Wanted::Both } else { Wanted::Gradients };
            let nodes = fine.get_mut(surface).and_then(|levels| levels.at(&spot, (grid, meridian), Some(solution)));
            if let Some(nodes) = nodes {
                for node in nodes {
                    let ring = node.ring(&spot, wanted);
                    add(node.weight, ring.single_flow(node.force));
                    if contrast != 0.0 {
                        let factor = contrast * node.weight * node.point.place.y;
                        add(factor, ring.double_flow(node.point.normal(), node.density));
                    }
                }
                continue;
            }
            panels.each((grid, meridian), &spot, wanted, |source| {
                add(source.weight, source.ring.single_flow(source.force_on(meridian)));
                if contrast != 0.0 {
                    let density = Vec2::new(
                        waves::dot(&solution.cos, &source.waves.cos),
                        waves::dot(&solution.sin, &source.waves.sin),
                    );
                    let factor = contrast * source.weight * source.point.place.y;
                    add(factor, source.ring.double_flow(source.point.normal(), density));
                }
            });
        }
        if let Some(walls) = walls {
            let Walls { grid, meridian, panels, shift, .. } = &mut **walls;
            let spot = meridian.spot(grid, place - *shift, panels);
            if let Some(nodes) = fine.last_mut().and_then(|levels| levels.at(&spot, (grid, meridian), None)) {
                nodes.iter().for_each(|node| add(node.weight, node.ring(&spot, Wanted::Both).single_flow(node.force)));
            } else {
                panels.each((grid, meridian), &spot, Wanted::Both, |source| {
                    add(source.weight, source.ring.single_flow(source.force_on(meridian)));
                });
            }
        }
        let (mut velocity, mut pressure, mut gradient) = sum;
        if let (Some(Tube { radius, .. }), true) = (&self.tube, self.flux != 0.0) {
            let [speed, slope] =
                container::poiseuille(*radius, place.y).map(|part| 8.0 * PI * viscosity * self.flux * part);
            velocity[0] += speed;
            gradient[0][1] += slope;
            pressure -= 8.0 * PI * self.flux * container::resistance(*radius, viscosity) * place.x;
        }
        let rate = 1.0 / (8.0 * PI * fluid.0);
        let mut sample = FlowSample {
            velocity: rate * Vec2::from(velocity),
            pressure: pressure / (8.0 * PI),
            gradient: gradient.map(|row| row.map(|value| rate * value)),
        };
        // Inside a rigid body.
        if fluid.0 == f64::INFINITY {
            let holds = |surface: &usize| (self.surfaces[*surface].measures(&self.grid)[0] - fluid.1).abs() == 0.0;
            let body = (0..self.len()).find(holds).and_then(|surface| self.rigid_velocity(surface));
            sample = FlowSample { velocity: Vec2::new(body.unwrap_or(0.0), 0.0), ..FlowSample::default() };
        }
        sample
    }
}

/// Adds the layers of a surface at a spot to the right-hand side, and to some columns of two rows of the matrix, for
/// the components along and from the axis.
fn add_pair(
    (grid, meridian): (&Grid, &Meridian),
    sides: &Sides,
    spot: &Spot,
    panels: &mut Panels,
    sum: &mut Vec2,
    (rows, columns): (&mut [f64], Range<usize>),
) {
    let (n, contrast) = (grid.nodes, sides.contrast());
    let width = rows.len() / 2;
    panels.each((grid, meridian), spot, sides.wanted(), |source| {
        let [[xx, xr], [rx, rr]] = source.ring.single();
        let force = source.weight * source.force_on(meridian);
        *sum += Vec2::new(xx * force.x + xr * force.y, rx * force.x + rr * force.y);
        if contrast != 0.0 {
            let factor = -contrast * source.weight * source.point.place.y;
            let kernel = source.ring.double(source.point.normal());
            for (row, [x, r]) in rows.chunks_exact_mut(width).zip(kernel) {
                let waves = source.waves;
                add_waves(&mut row[columns.clone()], [factor * x, factor * r], &waves.cos[..n], &waves.sin[1..=n]);
            }
        }
    });
}

/// Adds multiples of waves of cosines and sines to a row of a matrix.
fn add_waves(row: &mut [f64], [x, r]: [f64; 2], cos: &[f64], sin: &[f64]) {
    let (of_x, of_r) = row.split_at_mut(cos.len());
    for ((of_x, of_r), (cos, sin)) in of_x.iter_mut().zip(of_r).zip(cos.iter().zip(sin)) {
        *of_x += x * cos;
        *of_r += r * sin;
    }
}

/// Takes over a surface given by the points of its closed curve, without forces if the list is empty.
fn load(
    halves: &mut Vec<Half>,
    grid: &Grid,
    meridian: &mut Meridian,
    positions: &[Vec2],
    forces: &[Vec2],
    curve: usize,
) -> Result<(), LayerError> {
    let count = positions.len();
    if !forces.is_empty() {
        same_length("the forces on a curve", count, forces.len())?;
    }
    let (least, most) = (2 * grid.nodes, MOST_POINTS as usize);
    if !(least..=most).contains(&count) {
        return Err(LayerError::Count { kind: "curve", curve, what: "points", found: count, least, most });
    }
    finite_vectors("the position", curve, positions)?;
    finite_vectors("the force", curve, forces)?;
    let intervals = count / 2;
    let mirrored = |k: usize| {
        let image = positions[(count - k) % count];
        Vec2::new(image.x, -image.y)
    };
    let size = positions[0].distance(positions[intervals]);
    let differs = |k: &usize| positions[*k].distance(mirrored(*k)) > ASYMMETRY * size;
    if !count.is_multiple_of(2) || (0..=intervals).any(|k| differs(&k)) {
        let point = (0..=intervals).find(differs).unwrap_or(count - 1);
        return Err(not_axisymmetric(curve, point, positions[point]));
    }
    let found = halves.iter().position(|half| half.intervals() == intervals);
    let half = found.unwrap_or_else(|| {
        halves.push(Half::new(intervals));
        halves.len() - 1
    });
    let half = &mut halves[half];
    half.analyse(
        grid.nodes,
        |k| ((0.5 * (positions[k] + mirrored(k))).x, 0.5 * (positions[k].y + mirrored(k).y)),
        &mut meridian.shape,
    );
    meridian.points = count;
    meridian.update(grid);
    // The meridian of a clockwise curve is its lower half.
    let mut below = meridian.nodes.iter().filter(|node| node.place.y <= 0.0);
    if below.clone().count() == meridian.nodes.len() || meridian.measures(grid)[0] <= 0.0 {
        return Err(LayerError::Clockwise { curve });
    }
    if let Some(node) = below.next() {
        return Err(meets_axis(curve, node.place.x));
    }
    // Force on both halves of a ring, per parameter and azimuth.
    let factor = count as f64 / (2.0 * PI * PI);
    let force = |k: usize| match forces {
        [] => Vec2::ZERO,
        _ => {
            let image = forces[(count - k) % count];
            0.5 * factor * (forces[k] + Vec2::new(image.x, -image.y))
        }
    };
    if forces.is_empty() || intervals == grid.nodes {
        half.analyse(grid.nodes, |k| (force(k).y, force(k).x), &mut meridian.force);
    } else {
        half.truncation(grid.nodes)?.apply(force, &mut meridian.force)?;
    }
    meridian.update_forces(grid);
    Ok(())
}

#[cfg(test)]
mod tests;
