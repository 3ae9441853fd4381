//! Springs along the edges of a mesh.

use motile_base::{Vec2, positive, same_length};

use super::{Bar, hyperelastic::Element};
use crate::material::Mat2;
use crate::mesh::TriangleMesh;
use crate::{ElasticForces, Moduli, SolidError};

/// A spring along every edge of a triangle mesh (Cowley section 4.1), without stress in the reference state. The force
/// on point i from the spring to j is `K_ij (|X_j - X_i| - d_ij)` towards j, d_ij being the reference length. (Cowley's
/// (4.1) has the opposite sign, and a half because it counts every spring from both ends.)
///
/// ```text
/// K_ij = 8/(3 d_ij^2) sum over the one or two triangles at the edge of mu A_ref
/// ```
/// makes the mesh an isotropic material of shear modulus mu and bulk modulus 2 mu, free edges included; on the
/// equilateral lattice K = 4 mu/sqrt(3). Cowley's (4.2) has the mean area of the edge's two points instead of the
/// two triangles', which is too soft next to free edges. All this holds for triangles of almost equal sides. One whose
/// longest side is more than 1.8 times the shortest, as in a [finer boundary](TriangleMesh::with_finer_boundary), has
/// no springs along its sides but the energy that its deformation gives springs along its longest side and at 60
/// degrees to it, as if it were part of an equilateral one.
#[derive(Debug, Clone)]
#[doc(alias("spring network", "spring lattice", "fibre", "fiber"))]
pub struct Springs {
    /// Springs along the edges, each with its spring constant (force per length).
    springs: Vec<(Bar, f64)>,
    /// Triangles of uneven sides, by index.
    uneven: Vec<(usize, Element)>,
    /// Directions and lengths of the springs of each triangle in the reference state, and its shear modulus.
    sides: Vec<([Vec2; 3], f64)>,
    points: usize,
}

/// Ratio of the longest to the shortest side of a triangle above which it has no springs along its sides: above the
/// ratios of relaxed meshes and below the 2 of a halved equilateral triangle.
const UNEVEN: f64 = 1.8;

impl Springs {
    /// Creates springs for one shear modulus everywhere (force per length); [`Moduli::from_thesis_spring_constant`]
    /// converts Cowley's k.
    ///
    /// # Errors
    /// Returns an error for a shear modulus that is not positive and finite.
    pub fn new(mesh: &TriangleMesh, shear: f64) -> Result<Self, SolidError> {
        Self::graded(mesh, |_| shear)
    }

    /// Returns the springs for a shear modulus (force per length) that is a function of the reference position
    /// (length), taken at the centroid of each triangle.
    ///
    /// # Errors
    /// Returns an error for a shear modulus that is not positive and finite.
    pub fn graded(mesh: &TriangleMesh, mut shear: impl FnMut(Vec2) -> f64) -> Result<Self, SolidError> {
        let mut uneven = Vec::new();
        let sides = (0..mesh.triangles().len())
            .map(|triangle| {
                let [a, b, c] = mesh.raw_corners(triangle, mesh.points());
                let mut sides = [b - a, c - b, a - c];
                let (longest, shortest) =
                    sides.iter().fold((Vec2::ZERO, f64::INFINITY), |(longest, shortest), side| {
                        let further = side.length() > longest.length();
                        (if further { *side } else { longest }, shortest.min(side.length()))
                    });
                if longest.length() > UNEVEN * shortest {
                    uneven.push((triangle, Element::of(mesh, triangle)));
                    sides = [0.0, 1.0, 2.0].map(|k| Vec2::from_angle(k * std::f64::consts::FRAC_PI_3).rotate(longest));
                }
                Ok((sides, positive("the shear modulus", shear(mesh.centroid(triangle)))?))
            })
            .collect::<Result<Vec<_>, SolidError>>()?;
        let even = |triangle: usize| uneven.binary_search_by_key(&triangle, |(number, _)| *number).is_err();
        let springs = Bar::all(mesh)
            .zip(mesh.edges())
            .map(|(bar, edge)| {
                let weight =
                    |triangle: usize| if even(triangle) { sides[triangle].1 * mesh.areas()[triangle] } else { 0.0 };
                let (left, right) = edge.triangles;
                (bar, stiffness(weight(left) + right.map_or(0.0, weight), bar.length))
            })
            .collect();
        Ok(Self { springs, uneven, sides, points: mesh.points().len() })
    }

    /// Returns the springs along the edges of the mesh, in their order, each with its spring constant (force per
    /// length). The constant of an edge between uneven triangles is zero.
    pub(crate) fn bars(&self) -> &[(Bar, f64)] {
        &self.springs
    }

    /// Returns the triangles of uneven sides, by index, which have no springs along their sides.
    pub(crate) fn uneven(&self) -> &[(usize, Element)] {
        &self.uneven
    }
}

/// Returns the spring constant `8 weight/(3 d^2)` (force per length) for `weight` = sum of mu A_ref (force times
/// length) over the triangles at the edge and the reference length d (length).
fn stiffness(weight: f64, rest: f64) -> f64 {
    8.0 / 3.0 * weight / (rest * rest)
}

impl ElasticForces for Springs {
    fn point_count(&self) -> usize {
        self.points
    }

    fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError> {
        same_length("the positions", self.points, positions.len())?;
        same_length("the forces", self.points, forces.len())?;
        for (bar, stiffness) in &self.springs {
            let span = bar.span(positions);
            // A spring of no length has no direction to push in.
            bar.add_pull(span * (stiffness * (1.0 - bar.length / span.length().max(f64::MIN_POSITIVE))), forces);
        }
        for (triangle, element) in &self.uneven {
            if let Some(stress) = self.stress(*triangle, &element.gradient(positions)) {
                element.add_forces(&stress, forces);
            }
        }
        Ok(())
    }

    fn energy(&self, positions: &[Vec2]) -> Result<f64, SolidError> {
        same_length("the positions", self.points, positions.len())?;
        let springs = self.springs.iter();
        let even =
            springs.map(|(bar, stiffness)| 0.5 * stiffness * (bar.span(positions).length() - bar.length).powi(2));
        let uneven = self.uneven.iter().map(|(triangle, element)| {
            let (sides, shear) = self.sides[*triangle];
            let gradient = element.gradient(positions);
            let strain = |side: Vec2| (gradient * side).length() / side.length() - 1.0;
            4.0 / 3.0 * shear * element.area * sides.iter().map(|side| strain(*side).powi(2)).sum::<f64>()
        });
        Ok(even.sum::<f64>() + uneven.sum::<f64>())
    }

    /// Returns the stress of a triangle's share of the springs along its sides: of a material with the energy density
    /// `4 mu/3 sum of (|A s|/|s| - 1)^2` over the sides s.
    fn stress(&self, triangle: usize, gradient: &Mat2) -> Option<Mat2> {
        let (sides, shear) = self.sides.get(triangle)?;
        let mut stress = Mat2::ZERO;
        for side in sides {
            let (rest, now) = (side.length(), *gradient * *side);
            let length = now.length().max(f64::MIN_POSITIVE);
            stress += Mat2::from_cols(now * side.x, now * side.y)
                * (8.0 / 3.0 * shear * (length - rest) / (length * rest * rest));
        }
        Some(stress)
    }

    fn stiffest(&self) -> Moduli {
        let shear = self.sides.iter().map(|&(_, shear)| shear).fold(0.0, f64::max);
        Moduli::springs_of_checked(shear)
    }
}
