//! Triangles that share their change of area.

use crate::mesh::TriangleMesh;

/// Patches of triangles of which each has the change of area of all of its patch, which keeps nearly incompressible
/// material from locking (de Souza Neto, Pires and Owen, Int. J. Numer. Meth. Engng 62 (2005) 353): pairs of
/// neighbours, which leave one condition for the two coordinates of a point, with the triangles that are left over.
#[derive(Debug, Clone)]
pub(super) struct Patches {
    /// Triangles patch by patch, and the end of each patch among them.
    triangles: Vec<usize>,
    ends: Vec<usize>,
}

impl Patches {
    /// Patches of a mesh, pairs along its edges in their order.
    pub(super) fn of(mesh: &TriangleMesh) -> Self {
        let mut home = vec![None; mesh.triangles().len()];
        let mut patches: Vec<Vec<usize>> = Vec::new();
        let neighbours = || mesh.edges().iter().filter_map(|edge| Some([edge.triangles.0, edge.triangles.1?]));
        for pair in neighbours() {
            if pair.iter().all(|triangle| home[*triangle].is_none()) {
                pair.iter().for_each(|triangle| home[*triangle] = Some(patches.len()));
                patches.push(pair.to_vec());
            }
        }
        // All neighbours of one that is left over are in pairs.
        for [one, other] in neighbours().flat_map(|[one, other]| [[one, other], [other, one]]) {
            if let (None, Some(patch)) = (home[one], home[other]) {
                home[one] = Some(patch);
                patches[patch].push(one);
            }
        }
        let alone = home.iter().enumerate().filter(|(_, patch)| patch.is_none());
        patches.extend(alone.map(|(triangle, _)| vec![triangle]));
        let ends = patches.iter().scan(0, |end, patch| {
            *end += patch.len();
            Some(*end)
        });
        Self { ends: ends.collect(), triangles: patches.concat() }
    }

    /// Returns the triangles of each patch.
    pub(super) fn iter(&self) -> impl Iterator<Item = &[usize]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(start, end)| &self.triangles[*start..*end])
    }
}
