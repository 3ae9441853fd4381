//! Walk over all shapes and outlines of a description, with their keys.

use super::{DropletShape, InterfaceShape, Setup, SolidOutline};

/// Returns the key of what a body of a list has.
fn key(list: &str, k: usize, entry: &str) -> String {
    format!("{list}[{k}]{entry}")
}

/// Defines the walks over references of one kind, shared or exclusive.
macro_rules! walks {
    ($shapes:ident, $outlines:ident, $lines:ident, $iter:ident $(, $mutable:tt)?) => {
        /// Returns the closed shapes of all bodies with their keys.
        pub(super) fn $shapes(&$($mutable)? self) -> impl Iterator<Item = (String, &$($mutable)? DropletShape)> {
            let Self { droplets, suspension, rigid_bodies, shells, .. } = self;
            let droplets = droplets.$iter().enumerate();
            let droplets = droplets.map(|(k, body)| (key("droplets", k, ".shape"), &$($mutable)? body.shape));
            let many = suspension.$iter().enumerate();
            let many = many.map(|(k, many)| (key("suspension", k, ".droplet.shape"), &$($mutable)? many.droplet.shape));
            let rigid = rigid_bodies.$iter().enumerate();
            let rigid = rigid.map(|(k, body)| (key("rigid-bodies", k, ".shape"), &$($mutable)? body.shape));
            let shells = shells.$iter().enumerate().flat_map(|(k, shell)| {
                let rest = shell.rest.$iter().map(move |rest| (key("shells", k, ".rest"), rest));
                std::iter::once((key("shells", k, ".shape"), &$($mutable)? shell.shape)).chain(rest)
            });
            droplets.chain(many).chain(rigid).chain(shells)
        }

        /// Returns the outlines of all solids and walls with their keys.
        pub(super) fn $outlines(&$($mutable)? self) -> impl Iterator<Item = (String, &$($mutable)? SolidOutline)> {
            let Self { solids, walls, .. } = self;
            let solids = solids.$iter().enumerate();
            let solids = solids.map(|(k, solid)| (key("solids", k, ".outline"), &$($mutable)? solid.outline));
            let walls = walls.$iter().enumerate();
            solids.chain(walls.map(|(k, wall)| (key("walls", k, ".outline"), &$($mutable)? wall.outline)))
        }

        /// Returns the shapes of all interfaces along x with their keys.
        pub(super) fn $lines(&$($mutable)? self) -> impl Iterator<Item = (String, &$($mutable)? InterfaceShape)> {
            let lines = self.interfaces.$iter().enumerate();
            lines.map(|(k, interface)| (key("interfaces", k, ".shape"), &$($mutable)? interface.shape))
        }
    };
}

impl Setup {
    walks!(shapes, outlines_of_solids, lines, iter);
    walks!(shapes_mut, outlines_of_solids_mut, lines_mut, iter_mut, mut);
}
