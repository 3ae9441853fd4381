//! Bodies that fill others of the scene.

use super::bodies::Bodies;
use crate::{Body, SceneError, body::InteriorBody};

impl Bodies {
    /// Takes down whom the next body fills, if anyone.
    pub(super) fn push_interior_body(&mut self, body: &mut dyn Body) {
        let next = self.list.len();
        if let Some(host) = body.as_interior_body().map(|interior_body| interior_body.host()) {
            if host.scene() == self.scene && host.index() < next {
                self.interior_bodies.push([host.index(), next]);
            } else {
                self.stray_interior_body = true;
            }
        }
    }

    /// Refuses interior_bodies whose hosts are not in this scene.
    pub(super) fn check_interior_bodies(&self) -> Result<(), SceneError> {
        if self.stray_interior_body { Err(SceneError::foreign_handle()) } else { Ok(()) }
    }

    /// Shows all interior_bodies their hosts in the present state.
    pub(super) fn update_hosts(&mut self) {
        for &numbers in &self.interior_bodies {
            if let Some((host, interior_body)) = pair(&mut self.list, numbers) {
                interior_body.update_host(host);
            }
        }
    }

    /// Shows a body its host in the present state, if it fills one.
    pub(super) fn update_host(&mut self, index: usize) {
        let Some(number) = self.interior_bodies.iter().position(|&[_, interior_body]| interior_body == index) else {
            return;
        };
        if let Some((host, interior_body)) = pair(&mut self.list, self.interior_bodies[number]) {
            interior_body.update_host(host);
        }
    }

    /// Adds the forces of interior_bodies on their hosts' markers.
    pub(super) fn add_interior_forces(&mut self) {
        for &[host, interior_body] in &self.interior_bodies {
            let range = self.markers.groups()[host].range.clone();
            if let Some(interior_body) = self.list[interior_body].as_interior_body() {
                interior_body.add_host_forces(&mut self.markers.forces[range]);
            }
        }
    }

    /// Adds what interior_bodies change in the states of their hosts.
    pub(super) fn add_interior_rates(&mut self, rate: &mut [f64]) {
        for &[host, interior_body] in &self.interior_bodies {
            let start: usize = self.list[..host].iter().map(|body| body.state_len()).sum();
            let end = start + self.list[host].state_len();
            if let Some(interior_body) = self.list[interior_body].as_interior_body() {
                interior_body.add_host_rate(&mut rate[start..end]);
            }
        }
    }

    /// Shows a body how its host moves, if it fills one.
    pub(super) fn host_moved(&mut self, index: usize) {
        let Some(number) = self.interior_bodies.iter().position(|&[_, interior_body]| interior_body == index) else {
            return;
        };
        let range = self.markers.groups()[self.interior_bodies[number][0]].range.clone();
        if let Some((host, interior_body)) = pair(&mut self.list, self.interior_bodies[number]) {
            interior_body.host_moved(host, &self.markers.velocities[range]);
        }
    }
}

/// Returns a host and its interior body, by their numbers.
fn pair(bodies: &mut [Box<dyn Body>], [host, interior_body]: [usize; 2]) -> Option<(&dyn Body, &mut dyn InteriorBody)> {
    let (before, from) = bodies.split_at_mut(interior_body);
    Some((before.get(host)?.as_ref(), from.first_mut()?.as_interior_body()?))
}

#[cfg(test)]
mod tests;
