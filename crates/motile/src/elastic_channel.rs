//! One active droplet between elastic walls, from a few numbers.

use active_interface::{ActiveDroplet, Curve};
use elastic_solids::{
    Channel, Mesher, Moduli, NeoHookean, Solid, SolidError, TriangleMesh,
    channel::{StraightChannel, Walls},
    solid::SurfaceGap,
};
use ib_core::{Handle, MobilityDeficit, Scene, Vec2};
use stokes_grid::{ChannelStokes, Drive, Grid};

use crate::{AnyFlow, Method, SetupError, Swimmer};

/// What elastic walls are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallMaterial {
    /// Springs along the edges of the mesh (thesis section 4.1), with the bulk modulus 2 mu.
    Springs,
    /// Generalised neo-Hookean material (thesis section 4.2).
    NeoHookean,
}

/// How the points of elastic walls are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallMesh {
    /// Equilateral triangles where the shape allows it, as in a straight wall.
    Equilateral,
    /// An even mesh that is no lattice.
    Unstructured,
}

/// What is done about the smearing of a wall's surface over the grid, by which a stiff wall stops the fluid 0.31 to
/// 0.44 grid spacings in front of its surface (with the default kernel).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallSurface {
    /// The mobility correction of the surface ([`elastic_solids::Solid::surface_corrected`]), of second order. A
    /// droplet that would start in touch with the walls starts squeezed a little, beside a film.
    Corrected,
    /// Walls are meshed as much further back ([`ElasticChannel::set_back`]). Leaves an error of first order, of a few
    /// tenths of a grid spacing where droplets keep away, but bears droplets that are pressed against a bent wall for
    /// long, such as the mouth of a constriction, where in time they enter corrected surfaces or turn a triangle of
    /// springs inside out.
    SetBack,
    /// Nothing, as in the thesis.
    Plain,
}

/// An active droplet in a channel between elastic walls (thesis chapter 4), in the thesis' units.
///
/// The flow is that of a channel with rigid walls, periodic in x, which is as high as the channel and both elastic
/// walls; the outermost row of each elastic wall is held by the rigid one. [`Swimmer::lengths`] are the period and the
/// width of the channel between the elastic walls.
///
/// ```
/// use motile::elastic_solids::{Moduli, channel::width_between};
/// use motile::prelude::*;
///
/// // Soft walls, k = 1e4 in the thesis, and a coarse grid.
/// let swimmer = Swimmer { activity: -4.0, lengths: [6.0, 2.0], spacing: 0.1, ..Swimmer::default() };
/// let channel = ElasticChannel::new(swimmer, Moduli::from_thesis_spring_constant(1e4)?);
/// let (mut scene, droplet, walls) = channel.build()?;
/// scene.run(1.0).go()?;
///
/// let width = width_between(scene.body(walls[0])?, scene.body(walls[1])?)?;
/// println!("width from {:.3} to {:.3}, {} markers", width.minimum, width.maximum, scene.body(droplet)?.markers().len());
/// assert!(width.minimum < 2.0 && width.maximum > 2.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticChannel {
    /// The droplet and the method; its lengths are the period and the width of the channel.
    pub swimmer: Swimmer,
    /// What the walls are made of.
    pub material: WallMaterial,
    /// Elastic moduli of small strains (force per length); springs take the shear modulus.
    pub moduli: Moduli,
    /// How the points of the walls are arranged.
    pub mesh: WallMesh,
    /// Spacing of the points (length); `None` for that of the grid.
    pub mesh_spacing: Option<f64>,
    /// Thickness of each wall beside the channel (length).
    pub thickness: f64,
    /// What is done about the smearing of the walls' surfaces.
    pub surface: WallSurface,
    /// Whether triangles of springs may turn inside out ([`Solid::allow_inversion`]).
    pub may_invert: bool,
    /// Force per displacement and area that holds islands in place ([`Solid::tethered`]; force per length cubed);
    /// `None` for the shear modulus over the square of the droplet's radius.
    pub hold: Option<f64>,
    /// What drives the flow along the channel.
    pub drive: Drive,
}

/// Angle by which the seeds of unstructured meshes are turned (radians).
const TURN: f64 = 0.2;
/// Offset of the plane where a stiff wall stops the fluid, over the deficit of its surface and the grid spacing: 0.315
/// grid spacings for the default kernel. Measured offsets are 0.31 to 0.44, depending on where the surface lies between
/// grid lines; this value gives droplets in films of 0.1 R0 between walls of k = 1e6 and h = 0.05 the speed they have
/// between rigid walls within 2 %.
const OFFSET: f64 = 1.35;
/// Film that is left beside a droplet squeezed to fit, over its radius.
const FILM: f64 = 0.05;
/// How deep the droplet may start inside a wall, over the grid spacing.
const OVERLAP: f64 = 0.25;

/// A scene, the droplet in it, and the elastic solids beside it (lower wall, upper wall, islands), or why there is
/// none.
pub type BuiltElastic = Result<(Scene<AnyFlow>, Handle<ActiveDroplet>, Vec<Handle<Solid>>), SetupError>;

impl ElasticChannel {
    /// Walls 1.5 R0 thick (the thesis') of springs on an equilateral lattice as fine as the grid.
    #[must_use]
    pub fn new(mut swimmer: Swimmer, moduli: Moduli) -> Self {
        swimmer.method = Method::ImmersedBoundary;
        Self {
            material: WallMaterial::Springs,
            moduli,
            mesh: WallMesh::Equilateral,
            mesh_spacing: None,
            thickness: 1.5 * swimmer.radius,
            surface: WallSurface::Corrected,
            may_invert: false,
            hold: None,
            drive: Drive::ZeroGradient,
            swimmer,
        }
    }

    /// Walls by the method of the thesis (section 4.1): springs on an unstructured mesh, nothing done about their
    /// surfaces, and triangles may turn inside out. For a droplet by its method too, make the swimmer from
    /// [`Swimmer::thesis`].
    #[must_use]
    pub fn thesis(swimmer: Swimmer, moduli: Moduli) -> Self {
        let mesh = WallMesh::Unstructured;
        Self { mesh, surface: WallSurface::Plain, may_invert: true, ..Self::new(swimmer, moduli) }
    }

    /// The scene of a straight channel.
    ///
    /// # Errors
    /// Parameters out of their range; lengths that do not hold a whole number of cells; a droplet that overlaps a wall.
    pub fn build(&self) -> BuiltElastic {
        let [period, width] = self.swimmer.lengths;
        self.build_in(&StraightChannel { period, width }.channel()?)
    }

    /// The scene of a channel of another shape, centred on y = 0 and with the period of [`Swimmer::lengths`]. Its walls
    /// reach [`ElasticChannel::thickness`] beyond the width of [`Swimmer::lengths`] on both sides.
    ///
    /// # Errors
    /// As [`ElasticChannel::build`]; a shape that cannot be meshed.
    pub fn build_in(&self, shape: &Channel) -> BuiltElastic {
        self.build_graded(shape, |_| self.moduli)
    }

    /// The same with moduli that are a function of the reference position (length): gradients of stiffness, one wall
    /// stiffer than the other.
    ///
    /// # Errors
    /// As [`ElasticChannel::build_in`].
    pub fn build_graded(&self, shape: &Channel, moduli: impl Fn(Vec2) -> Moduli) -> BuiltElastic {
        let swimmer = &self.swimmer;
        let [lx, ly] = swimmer.lengths;
        if (shape.period() - lx).abs() > 1e-9 * lx {
            return Err(SolidError::DifferentPeriods { first: lx, second: shape.period() }.into());
        }
        let height = ly + 2.0 * self.thickness;
        let grid = Grid::channel(swimmer.cells(lx)?, swimmer.cells(height)?, swimmer.spacing)?;
        let droplet = self.droplet()?;
        let solids = self.solids(shape, moduli)?;

        let mut gap = SurfaceGap::new(Some(lx));
        solids.iter().try_for_each(|solid| gap.add(solid))?;
        gap.sort();
        let (depth, marker) = gap.smallest(droplet.markers())?;
        if depth < self.set_back() - OVERLAP * swimmer.spacing {
            let place = droplet.markers()[marker];
            return Err(SetupError::Overlap { x: place.x, y: place.y, depth: -depth });
        }

        let mut solver = ChannelStokes::new(grid, swimmer.viscosity)?;
        solver.set_drive(self.drive)?;
        let mut scene = Scene::new(swimmer.any_grid(solver)?).with_step_size(swimmer.step);
        let droplet = scene.add(droplet);
        let solids = solids.into_iter().map(|solid| scene.add(solid)).collect();
        Ok((scene, droplet, solids))
    }

    /// How far the meshed surfaces of the walls lie behind those where they stop the fluid (length); islands are meshed
    /// as they are.
    #[must_use]
    pub fn set_back(&self) -> f64 {
        if self.surface == WallSurface::SetBack {
            let deficit = MobilityDeficit::new(&self.swimmer.kernel).at(0.0);
            OFFSET * deficit.tangential * self.swimmer.spacing
        } else {
            0.0
        }
    }

    /// The solids of a channel without a scene: lower wall, upper wall, islands.
    ///
    /// # Errors
    /// A shape that cannot be meshed.
    pub fn solids(&self, shape: &Channel, moduli: impl Fn(Vec2) -> Moduli) -> Result<Vec<Solid>, SetupError> {
        let half = 0.5 * self.swimmer.lengths[1] + self.thickness;
        let mesher = Mesher::new(self.mesh_spacing.unwrap_or(self.swimmer.spacing))?;
        let mesher = if self.mesh == WallMesh::Unstructured { mesher.turned(TURN)? } else { mesher };
        let set_back = self.set_back();
        let widened = if set_back > 0.0 { shape.widened(2.0 * set_back)? } else { shape.clone() };
        let Walls { lower, upper, islands } = widened.walls(-half, half, &mesher)?;
        let finished = |solid: Solid| {
            let solid = if self.may_invert { solid.allow_inversion() } else { solid };
            if self.surface == WallSurface::Corrected { solid.surface_corrected() } else { solid }
        };
        let mut solids = Vec::new();
        for (name, mesh) in [("lower wall", lower), ("upper wall", upper)] {
            let wall = self.solid(mesh, &moduli)?.named(name);
            solids.push(finished(wall.pinned(|s| s.y.abs() > half * (1.0 - 1e-9))?));
        }
        let radius = self.swimmer.radius;
        for (number, mesh) in islands.into_iter().enumerate() {
            let share = mesh.area() / mesh.points().len() as f64;
            let hold = self.hold.unwrap_or(self.moduli.shear() / (radius * radius));
            let island = self.solid(mesh, &moduli)?.named(&format!("island {}", number + 1));
            solids.push(finished(island.tethered(hold * share, |_| true)?));
        }
        Ok(solids)
    }

    fn solid(&self, mesh: TriangleMesh, moduli: impl Fn(Vec2) -> Moduli) -> Result<Solid, SolidError> {
        match self.material {
            WallMaterial::Springs => Solid::springs_graded(mesh, |place| moduli(place).shear()),
            WallMaterial::NeoHookean => Solid::hyperelastic_graded(mesh, |place| Ok(NeoHookean::from(moduli(place)))),
        }
    }

    /// Half the length of the straight sides and the radius of the ends (length) of the stadium as which the droplet
    /// starts in a channel narrower than itself, beside a film; a circle has no straight sides. `None` where the
    /// channel does not hold the droplet.
    #[must_use]
    pub fn start_shape(&self) -> Option<(f64, f64)> {
        let ([lx, ly], y, radius) = (self.swimmer.lengths, self.swimmer.offset[1], self.swimmer.radius);
        let room = 0.5 * ly - y.abs();
        // What touches a wall that stops the fluid at its surface has no film, and none would come between them.
        let film = if self.surface == WallSurface::Corrected { FILM * radius } else { 0.0 };
        if room >= radius * (1.0 - 1e-12) + film {
            return Some((0.0, radius));
        }
        let half = room - FILM * radius;
        let straight = 0.25 * std::f64::consts::PI * (radius * radius - half * half) / half;
        (half > 0.1 * radius && 2.0 * (straight + half) < lx).then_some((straight, half))
    }

    /// The droplet: a circle, or where the channel is narrower a stadium of the same area that leaves a film beside it.
    fn droplet(&self) -> Result<ActiveDroplet, SetupError> {
        let swimmer = &self.swimmer;
        match self.start_shape() {
            Some((0.0, _)) => swimmer.droplet(),
            Some((straight, half)) => {
                let [x, y] = swimmer.offset;
                let curve = Curve::stadium(straight, half)?.translated(Vec2::new(x, y));
                swimmer.droplet_with(&swimmer.markers_along(&curve)?)
            }
            None => {
                let [lx, ly] = swimmer.lengths;
                let problem =
                    "does not hold the droplet: move it to the centre line or make the channel wider or longer";
                Err(SetupError::Box { lx, ly, spacing: swimmer.spacing, problem })
            }
        }
    }
}
