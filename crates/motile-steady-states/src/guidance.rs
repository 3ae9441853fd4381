//! Guidance of a swimmer by weak gradients of the activity and by the noise of its particles.

use motile_base::{PeriodicSeries, Region, Vec2};
use nalgebra::DVector;

use crate::modes::Part;
use crate::system::{Equations, System};
use crate::{Parameter, SteadyError, SteadyState};

/// Speed, over the radius times the rate of diffusion, of a droplet that swims: one at rest has no heading.
const SLOWEST: f64 = 1e-6;

/// Linear response of a steady swimmer in the plane to weak gradients of its activity and to the noise of its particles
/// ([`SteadyState::guidance`]).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[doc(alias("chemotaxis", "phototaxis", "rotational diffusion", "durotaxis"))]
pub struct Guidance {
    /// Rate of turning over the slope of the activity across the way of the swimmer (1/time over force per number of
    /// particles). It is positive if the swimmer turns to where its activity is larger, so less contractile.
    pub turning: f64,
    /// Change of the speed over the slope of the activity along the way (length per time over force per number of
    /// particles). The activity in the centre of the swimmer stays.
    pub speed: f64,
    /// Constant at which the heading diffuses (1/time), `<angle^2> = 2 D_r t`, if particles diffuse independently, and
    /// each unit of the particle number is one particle.
    #[doc(alias("D_r"))]
    pub rotational_diffusion: f64,
}

impl SteadyState {
    /// Returns how gradients of the activity and the noise of the particles steer this swimmer in the plane. A swimmer
    /// that turns stays as it is, so that small causes add up: the left null vector of its equations has their effect.
    ///
    /// # Errors
    /// Returns an error for another region than the plane, an imposed flow, a droplet without particles, with an
    /// exchange of particles or a nucleus, or at rest; a flow that cannot be solved for.
    pub fn guidance(&self) -> Result<Guidance, SteadyError> {
        let setup = self.setup();
        let particles = setup.droplets[0].particles;
        let alone = setup.rigid_bodies.is_empty() && particles.is_some_and(|particles| particles.exchange.is_none());
        if setup.region != Region::Plane || !setup.flow.is_none() || !alone {
            return Err(SteadyError::unsupported(
                "what turns a swimmer is known only in the plane, without an imposed flow, a nucleus and an exchange",
                "Use the region `plane`, or run the scene with a field",
            ));
        }
        let mut system = System::new(setup)?;
        let slowest = SLOWEST * system.model.radius * system.model.rate_unit();
        let Some(heading) = self.velocity().try_normalize().filter(|_| self.velocity().length() > slowest) else {
            return Err(SteadyError::unsupported("the droplet is at rest", "Use an activity beyond its threshold"));
        };
        let point = self.point().clone();
        // Without the symmetry of the swimmer, because gradients across the way have another one.
        let equations = system.equations(&point, Part::Full, None)?;
        let rates = system.residual(&point)?;
        // The equations are linear in the slope.
        let unit = Parameter::Activity.scale(setup) / system.model.radius;
        let mut turned = [[0.0; 3]; 2];
        for (direction, turned) in [heading, heading.perp()].into_iter().zip(&mut turned) {
            system.model.activity_slope = unit * direction;
            let changed = system.residual(&point);
            system.model.activity_slope = Vec2::ZERO;
            let change = (changed? - &rates) / unit;
            let right = equations.right(&system, &change, [0.0; 2], system.model.rate_unit());
            *turned = equations.correction(&system, &equations.solve(&right)?).frame;
        }
        let [along, across] = turned;
        let by_noise = Self::turn_by_rates(&mut system, &equations)?;
        system.load(&point)?;
        Ok(Guidance {
            turning: across[2],
            speed: heading.dot(Vec2::new(along[0], along[1])),
            rotational_diffusion: Self::diffusion_by(&system, &by_noise)?,
        })
    }

    /// Returns the rate of turning that a unit source of particles at each node causes, per parameter.
    fn turn_by_rates(system: &mut System, equations: &Equations) -> Result<DVector<f64>, SteadyError> {
        let nodes = system.modes.nodes();
        let by_equation = equations.turning(system)?;
        let range = system.modes.part(equations.part());
        let step = std::f64::consts::TAU / nodes as f64;
        let zeros = vec![0.0; nodes];
        let mut found = DVector::zeros(nodes);
        for node in 0..nodes {
            let mut source = zeros.clone();
            source[node] = 1.0 / step;
            let rates = system.modes.analyse(&zeros, &source)?;
            found[node] = by_equation.rows(0, range.len()).dot(&rates.rows(range.start, range.len()));
        }
        Ok(found)
    }

    /// Returns `D INT c (dy/ds)^2 ds` for the rate of turning y that a source of particles causes.
    fn diffusion_by(system: &System, turning: &DVector<f64>) -> Result<f64, SteadyError> {
        let nodes = turning.len();
        let mut series = PeriodicSeries::new(nodes)?;
        series.analyse(turning.iter().map(|y| (*y).into()))?;
        series.differentiate();
        let step = std::f64::consts::TAU / nodes as f64;
        let model = &system.model;
        let terms = series.values().iter().zip(&model.concentrations).zip(model.stretches());
        Ok(model.diffusion * step * terms.map(|((slope, c), stretch)| c * slope.re * slope.re / stretch).sum::<f64>())
    }
}
