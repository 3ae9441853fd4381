//! Bodies that fill others of the scene.

use super::bodies::Bodies;
use crate::{Body, SceneError, body::Guest};

impl Bodies {
    /// Takes down whom the next body fills, if anyone.
    pub(super) fn push_guest(&mut self, body: &mut dyn Body) {
        let next = self.list.len();
        if let Some(host) = body.as_guest().map(|guest| guest.host()) {
            if host.scene() == self.scene && host.index() < next {
                self.guests.push([host.index(), next]);
            } else {
                self.stray_guest = true;
            }
        }
    }

    /// Refuses guests whose hosts are not in this scene.
    pub(super) fn check_guests(&self) -> Result<(), SceneError> {
        if self.stray_guest { Err(SceneError::ForeignHandle) } else { Ok(()) }
    }

    /// Shows all guests their hosts in the present state.
    pub(super) fn update_hosts(&mut self) {
        for &numbers in &self.guests {
            if let Some((host, guest)) = pair(&mut self.list, numbers) {
                guest.update_host(host);
            }
        }
    }

    /// Shows a body its host in the present state, if it fills one.
    pub(super) fn update_host(&mut self, index: usize) {
        let Some(number) = self.guests.iter().position(|&[_, guest]| guest == index) else { return };
        if let Some((host, guest)) = pair(&mut self.list, self.guests[number]) {
            guest.update_host(host);
        }
    }

    /// Adds the forces of guests on their hosts' markers.
    pub(super) fn add_guest_forces(&mut self) {
        for &[host, guest] in &self.guests {
            let range = self.markers.groups()[host].range.clone();
            if let Some(guest) = self.list[guest].as_guest() {
                guest.add_host_forces(&mut self.markers.forces[range]);
            }
        }
    }

    /// Adds what guests change in the states of their hosts.
    pub(super) fn add_guest_rates(&mut self, rate: &mut [f64]) {
        for &[host, guest] in &self.guests {
            let start: usize = self.list[..host].iter().map(|body| body.state_len()).sum();
            let end = start + self.list[host].state_len();
            if let Some(guest) = self.list[guest].as_guest() {
                guest.add_host_rate(&mut rate[start..end]);
            }
        }
    }

    /// Shows a body how its host moves, if it fills one.
    pub(super) fn host_moved(&mut self, index: usize) {
        let Some(number) = self.guests.iter().position(|&[_, guest]| guest == index) else { return };
        let range = self.markers.groups()[self.guests[number][0]].range.clone();
        if let Some((host, guest)) = pair(&mut self.list, self.guests[number]) {
            guest.host_moved(host, &self.markers.velocities[range]);
        }
    }
}

/// A host and its guest, by their numbers.
fn pair(bodies: &mut [Box<dyn Body>], [host, guest]: [usize; 2]) -> Option<(&dyn Body, &mut dyn Guest)> {
    let (before, from) = bodies.split_at_mut(guest);
    Some((before.get(host)?.as_ref(), from.first_mut()?.as_guest()?))
}
