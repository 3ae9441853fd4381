//! Handles of the bodies of a scene.

use std::marker::PhantomData;
use std::sync::atomic::{AtomicU64, Ordering};

/// Number of a scene, unique in a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct SceneId(u64);

impl SceneId {
    /// Creates a number that no other scene has.
    pub(crate) fn unique() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// A body of type B in the scene that it was added to. Other scenes refuse it ([`crate::SceneError::Refused`]). It is
/// valid for as long as the scene lives.
pub struct Handle<B: ?Sized> {
    scene: SceneId,
    index: usize,
    body: PhantomData<fn() -> Box<B>>,
}

// Derived implementations would ask as much of B.
impl<B: ?Sized> Clone for Handle<B> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<B: ?Sized> Copy for Handle<B> {}
impl<B: ?Sized> std::fmt::Debug for Handle<B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Handle({} of scene {})", self.index, self.scene.0)
    }
}
impl<B: ?Sized> PartialEq for Handle<B> {
    fn eq(&self, other: &Self) -> bool {
        (self.scene, self.index) == (other.scene, other.index)
    }
}
impl<B: ?Sized> Eq for Handle<B> {}

impl<B: ?Sized> Handle<B> {
    pub(crate) fn new(scene: SceneId, index: usize) -> Self {
        Self { scene, index, body: PhantomData }
    }

    /// Returns the handle of the body as one of another type.
    pub(crate) fn cast<C: ?Sized>(self) -> Handle<C> {
        Handle::new(self.scene, self.index)
    }

    pub(crate) fn scene(&self) -> SceneId {
        self.scene
    }

    /// Returns the number of the body, in the order of addition; also the number of its group in
    /// [`crate::System::markers`].
    #[must_use]
    pub fn index(&self) -> usize {
        self.index
    }
}
