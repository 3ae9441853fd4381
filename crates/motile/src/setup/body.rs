//! Bodies of descriptions, whatever their kind.

use motile_base::Vec2;
use motile_scene::{Body, MarkerKind, Scene, gap::Boundary};

use super::{AnyFlow, MethodKind, Setup, checked::Checked};
use crate::SetupError;

/// An entry of a description that becomes a body of the scene. Each kind of body is a list of [`Setup`], whose entries
/// implement this trait.
pub(super) trait BodySetup {
    /// Returns the key of its list, and the name of an entry that has none.
    fn kind(&self) -> [&'static str; 2];

    /// Its name.
    fn name(&self) -> &str;

    /// Returns the name of its kind in the plural and the methods that compute it, where not every method does.
    fn needs(&self) -> Option<(&'static str, &'static [MethodKind])> {
        None
    }

    /// Refuses values out of their range, and values that do not fit together.
    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError>;

    /// Returns the body before anything is meshed.
    fn plan<'a>(&'a self, setup: &'a Setup) -> Result<Planned<'a>, SetupError>;
}

/// Puts a body that has been planned, and what fills it, into the scene.
type Adding<'a> = Box<dyn FnOnce(&mut Scene<AnyFlow>) -> Result<(), SetupError> + 'a>;

/// A body before it is added to a scene: where it is, and how it is made and added.
pub(super) struct Planned<'a> {
    pub(super) boundary: Boundary,
    pub(super) kind: MarkerKind,
    /// Corners that have to lie within the region (length); none for a body that spans it.
    pub(super) corners: Vec<Vec2>,
    pub(super) add: Adding<'a>,
}

impl Planned<'_> {
    /// Creates a body that needs no mesh.
    pub(super) fn of(body: impl Body) -> Self {
        let (boundary, kind, mut corners) =
            (Boundary::of(&body, [None; 2]), body.kind(), vec![Vec2::ZERO; body.marker_count()]);
        body.write_markers(&mut corners);
        let add = |scene: &mut Scene<AnyFlow>| {
            scene.add(body);
            Ok(())
        };
        Self { boundary, kind, corners, add: Box::new(add) }
    }
}

/// Returns the entries of a list with their numbers.
pub(super) fn numbered<B: BodySetup>(list: &[B]) -> impl Iterator<Item = (usize, &dyn BodySetup)> {
    list.iter().map(|body| -> &dyn BodySetup { body }).enumerate()
}
