//! The scales of a description, for defaults that must not depend on its units.

use super::Setup;

impl Setup {
    /// Returns the length that the scene is about. It is the radius of its first droplet, or of its first rigid body or
    /// shell, or a sixth of the smaller side of its region. It is 1 if it has none of these. Suspensions count once
    /// they are placed ([`Setup::placed`]).
    #[must_use]
    pub fn length_scale(&self) -> f64 {
        let shapes = self.droplets.iter().map(|droplet| &droplet.shape);
        let others =
            self.rigid_bodies.iter().map(|body| &body.shape).chain(self.shells.iter().map(|shell| &shell.shape));
        let side = self.region.lengths().into_iter().filter(|side| side.is_finite()).reduce(f64::min);
        shapes.chain(others).find_map(|shape| shape.radius().ok()).or(side.map(|side| side / 6.0)).unwrap_or(1.0)
    }

    /// Returns the name of the unit of length for labels of pictures: `R_{0}` if the radius of the first droplet is 1,
    /// and nothing otherwise, because the description does not name the unit then.
    #[must_use]
    pub fn length_unit(&self) -> &'static str {
        let radius = self.droplets.first().and_then(|droplet| droplet.shape.radius().ok());
        let is_unit = |radius: f64| (radius - 1.0).abs() < 0.01;
        if radius.is_some_and(is_unit) { "R_{0}" } else { "" }
    }

    /// Returns the time that the scene is about, a tenth of which is a fair interval between pictures. It is the time
    /// in which particles diffuse over the length scale L, `0.1 L^2/D`, or in which the tension restores a droplet's
    /// shape, `0.1 eta L/gamma`. Without them, it is the time of the imposed flow, the period of the wave of a fibre,
    /// or the time in which a fibre straightens; 1 if there is none of these.
    #[must_use]
    pub fn time_scale(&self) -> f64 {
        let length = self.length_scale();
        let particles = self.droplets.iter().filter_map(|droplet| droplet.particles);
        let particles = particles.chain(self.interfaces.iter().filter_map(|interface| interface.particles));
        let diffusion = particles.map(|particles| length * length / particles.diffusion);
        let tensions = self.droplets.iter().map(|droplet| droplet.tension);
        let tensions = tensions.chain(self.interfaces.iter().map(|interface| interface.tension));
        let relaxation = tensions.map(|tension| self.viscosity * length / tension);
        let flow = self.flow.imposed(&self.region).ok().map(|flow| 10.0 / (flow.rate() + flow.bend.abs() * length));
        let weight = |droplet: &super::DropletSetup| {
            let area = std::f64::consts::PI * length * length;
            let [x, y] = [0, 1].map(|axis| droplet.body_force[axis] + droplet.force[axis] / area);
            10.0 * self.viscosity / (x.hypot(y) * length)
        };
        let fibres = self.fibres.iter().map(|fibre| fibre.time(self));
        let times = diffusion.chain(relaxation).chain(flow).chain(self.droplets.iter().map(weight)).chain(fibres);
        times.map(|time| 0.1 * time).find(|time| time.is_finite() && *time > 0.0).unwrap_or(1.0)
    }
}

#[cfg(test)]
mod tests;
