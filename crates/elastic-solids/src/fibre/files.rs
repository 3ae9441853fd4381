//! Fibres from the files of other programs.

use std::path::Path;

use motile_base::{Vec2, internal::Refuse};

use super::{Fibre, Target};
use crate::{SolidError, error::MOST_POINTS};

/// Contents of the files `name.vertex`, `name.spring`, `name.beam` and `name.target` of IBAMR and IB2d, of which one
/// chain of nodes makes a fibre ([`FibreFiles::fibre`]).
///
/// The first line of each file is the number of lines that follow; what comes after `#`, `!`, `%` or `//` is a comment.
///
/// | file | columns | meaning |
/// |---|---|---|
/// | vertex | x, y | place of a node (length) |
/// | spring | two nodes, k, length at rest | force `k (l - L)`, so that S is k L |
/// | beam | three nodes, c | energy `c/2 abs(a - 2 b + c)^2`, so that B is `c M^3` |
/// | beam | three nodes, c, cx, cy | the same with a vector at rest |
/// | beam | three nodes, k, C | IB2d: energy `k/2 (product - C)^2`, so that B is `k M^5`, curvature `-C/M^3` |
/// | target | node, k | spring from the node to its place |
///
/// Nodes count from 0 as in IBAMR, or from 1 as in IB2d if no spring has a node 0. M is half of the length at rest of
/// the two segments that meet at a node. For small turns from node to node, beams are
/// as stiff as in the other program. The lines of a spring may have more columns, which are not read: they are taken
/// as linear springs, without damping.
#[derive(Debug, Clone, PartialEq, Default)]
#[doc(alias("IBAMR", "IB2d", "vertex", "spring", "beam", "target"))]
pub struct FibreFiles {
    nodes: Vec<Vec2>,
    springs: Vec<([usize; 2], [f64; 2])>,
    beams: Vec<([usize; 3], BeamLaw)>,
    targets: Vec<(usize, f64)>,
}

/// Stiffness of a beam, and what is at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
enum BeamLaw {
    /// From the difference of vectors.
    Difference(f64, Vec2),
    /// From the product of vectors.
    Product(f64, f64),
}

/// Rows of numbers of a file, with the numbers of their lines.
type Rows = Vec<(usize, Vec<f64>)>;

fn refused(file: &str, line: usize, fault: impl Into<String>, remedy: &str) -> SolidError {
    SolidError::refused(format!("line {line} of the {file} file cannot be used"), fault, remedy)
}

/// Returns the rows of a file, each of at least `least` numbers.
fn rows(file: &str, text: &str, least: usize) -> Result<Rows, SolidError> {
    let mut found: Rows = Vec::new();
    let mut expected = None;
    for (number, line) in text.lines().enumerate() {
        let line_number = number + 1;
        let end = ["#", "!", "%", "//"].iter().filter_map(|mark| line.find(mark)).min().unwrap_or(line.len());
        let words: Vec<&str> = line[..end].split_whitespace().collect();
        if words.is_empty() {
            continue;
        }
        let parse = |word: &&str| {
            let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| refused(file, line_number, format!("{word:?} is not a number"), "Use finite numbers"))
        };
        let Some(count) = expected else {
            let count = parse(&words[0])?;
            let whole = (0.0..=MOST_POINTS).contains(&count) && count.fract() == 0.0;
            if !whole {
                let fault = format!("{count} is not a number of lines");
                return Err(refused(file, line_number, fault, "Begin the file with the number of lines that follow"));
            }
            expected = Some(count as usize);
            continue;
        };
        if found.len() == count {
            return Err(refused(file, line_number, format!("{count} lines were announced"), "Correct the first line"));
        }
        let numbers = words.iter().map(parse).collect::<Result<Vec<f64>, _>>()?;
        if numbers.len() < least {
            let fault = format!("it has {} numbers", numbers.len());
            return Err(refused(file, line_number, fault, &format!("Give {least} or more")));
        }
        found.push((line_number, numbers));
    }
    let expected = expected.unwrap_or(0);
    if found.len() < expected {
        let value = format!("{expected} lines were announced and {} found", found.len());
        return Err(SolidError::refused(format!("the {file} file ends too early"), value, "Correct the first line"));
    }
    Ok(found)
}

/// Returns the numbers of nodes, from 0, at the start of rows that count from `first`.
fn indices<const N: usize>(file: &str, rows: &Rows, [first, count]: [usize; 2]) -> Result<Vec<[usize; N]>, SolidError> {
    let of_row = |(line, numbers): &(usize, Vec<f64>)| {
        let mut nodes = [0; N];
        for (node, number) in nodes.iter_mut().zip(numbers) {
            let index = number - first as f64;
            if index.fract() != 0.0 || index < 0.0 || index >= count as f64 {
                let remedy = format!("Use whole numbers: there are {count} nodes");
                return Err(refused(file, *line, format!("node {number} does not exist"), &remedy));
            }
            *node = index as usize;
        }
        Ok(nodes)
    };
    rows.iter().map(of_row).collect()
}

impl FibreFiles {
    /// Reads the files with this common part of their names: `name.vertex` and `name.spring`, and `name.beam` and
    /// `name.target` where they exist.
    ///
    /// # Errors
    /// Returns the errors of [`FibreFiles::texts`] and [`FibreFiles::parse`].
    pub fn read(name: &Path) -> Result<Self, SolidError> {
        Self::parse(Self::texts(name)?.each_ref().map(String::as_str))
    }

    /// Returns the texts of the files of vertices, springs, beams and targets, as [`FibreFiles::parse`] takes them.
    ///
    /// # Errors
    /// Returns an error for files that cannot be read.
    pub fn texts(name: &Path) -> Result<[String; 4], SolidError> {
        let text = |ending: &str, needed: bool| {
            let mut path = name.as_os_str().to_owned();
            path.push(ending);
            match std::fs::read_to_string(&path) {
                Ok(text) => Ok(text),
                Err(error) if error.kind() == std::io::ErrorKind::NotFound && !needed => Ok(String::new()),
                Err(error) => {
                    let what = format!("the file {} cannot be read", path.to_string_lossy());
                    let remedy = "Give the common part of the names of its files, from the folder where you run";
                    Err(SolidError::refused(what, error.to_string(), remedy))
                }
            }
        };
        let [springs, beams, targets] = [text(".spring", true)?, text(".beam", false)?, text(".target", false)?];
        Ok([text(".vertex", true)?, springs, beams, targets])
    }

    /// Reads the texts of the files of vertices, springs, beams and targets; an empty text is a file that does not
    /// exist.
    ///
    /// # Errors
    /// Returns an error, with its line, for what is not as described above: words that are not numbers, negative
    /// stiffnesses, nodes that do not exist, and another number of lines than announced.
    pub fn parse([vertices, springs, beams, targets]: [&str; 4]) -> Result<Self, SolidError> {
        let nodes: Vec<Vec2> = rows("vertex", vertices, 2)?.iter().map(|(_, row)| Vec2::new(row[0], row[1])).collect();
        let stiffness = |file: &str, (line, row): &(usize, Vec<f64>), column: usize| match row[column] {
            value if value >= 0.0 => Ok(value),
            value => Err(refused(file, *line, format!("the stiffness {value} is negative"), "Use 0 or more")),
        };
        let springs = rows("spring", springs, 4)?;
        // The springs of a chain name all nodes.
        let from_one = springs.iter().all(|(_, row)| row[0] >= 1.0 && row[1] >= 1.0);
        let named = [usize::from(from_one), nodes.len()];
        let ends = indices::<2>("spring", &springs, named)?.into_iter().zip(&springs);
        let springs = ends.map(|(ends, row)| Ok((ends, [stiffness("spring", row, 2)?, row.1[3]])));
        let springs = springs.collect::<Result<_, SolidError>>()?;
        let beams = rows("beam", beams, 4)?;
        let triples = indices::<3>("beam", &beams, named)?.into_iter().zip(&beams);
        let beams = triples.map(|(triple, row)| {
            let modulus = stiffness("beam", row, 3)?;
            let law = match row.1[4..] {
                [] => BeamLaw::Difference(modulus, Vec2::ZERO),
                [curvature] => BeamLaw::Product(modulus, curvature),
                [x, y, ..] => BeamLaw::Difference(modulus, Vec2::new(x, y)),
            };
            Ok((triple, law))
        });
        let beams = beams.collect::<Result<_, SolidError>>()?;
        let targets = rows("target", targets, 2)?;
        let held = indices::<1>("target", &targets, named)?.into_iter().zip(&targets);
        let targets = held.map(|([node], row)| Ok((node, stiffness("target", row, 1)?)));
        let targets = targets.collect::<Result<_, SolidError>>()?;
        Ok(Self { nodes, springs, beams, targets })
    }

    /// Returns the nodes in the order of the chain, and true if it is closed.
    fn chain(&self) -> Result<(Vec<usize>, bool), SolidError> {
        let count = self.nodes.len();
        let no_chain = |what: String| {
            let remedy = "Use springs that join all nodes to one line, open or closed";
            SolidError::refused("the springs do not form one chain", what, remedy)
        };
        let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); count];
        for ([first, second], _) in &self.springs {
            neighbours[*first].push(*second);
            neighbours[*second].push(*first);
        }
        if let Some(node) = neighbours.iter().position(|list| list.is_empty() || list.len() > 2) {
            return Err(no_chain(format!("node {node}, from 0, has {} springs", neighbours[node].len())));
        }
        let tip = neighbours.iter().position(|list| list.len() == 1);
        let (mut order, mut last) = (vec![tip.unwrap_or(0)], usize::MAX);
        while let Some(&node) = order.last() {
            // A closed chain starts towards the later of the first node's neighbours only if that is all there is.
            let next = neighbours[node].iter().copied().find(|&next| next != last && next != order[0]);
            last = node;
            match next {
                Some(next) if order.len() < count => order.push(next),
                _ => break,
            }
        }
        if order.len() < count {
            return Err(no_chain(format!("{} of {count} nodes hang together", order.len())));
        }
        Ok((order, tip.is_none()))
    }

    /// Returns the fibre: its nodes in the order of the chain of springs, from the end that the file of vertices names
    /// first. A node without a beam does not resist bending.
    ///
    /// # Errors
    /// Returns an error for springs that do not join all nodes to one line, open or closed; springs of no length at
    /// rest; beams of nodes that are not neighbours; and the errors of [`Fibre::new`].
    pub fn fibre(&self) -> Result<Fibre, SolidError> {
        let (order, closed) = self.chain()?;
        let places: Vec<Vec2> = order.iter().map(|node| self.nodes[*node]).collect();
        let fibre = if closed { Fibre::closed(&places, 0.0, 0.0)? } else { Fibre::new(&places, 0.0, 0.0)? };
        let count = order.len();
        let mut place_of = vec![0; count];
        order.iter().enumerate().for_each(|(place, node)| place_of[*node] = place);
        let segments = count - usize::from(!closed);
        let (mut lengths, mut stretching) = (vec![0.0; segments], vec![0.0; segments]);
        for ([first, second], [stiffness, length]) in &self.springs {
            let [low, high] = [place_of[*first].min(place_of[*second]), place_of[*first].max(place_of[*second])];
            let segment = if high - low == 1 { low } else { high };
            if *length <= 0.0 {
                let what = format!("the spring between the nodes {first} and {second}, from 0, has no length at rest");
                return Err(SolidError::refused(what, format!("{length}"), "Give a positive length"));
            }
            (lengths[segment], stretching[segment]) = (*length, stiffness * length);
        }
        let (mut bending, mut curvatures) = (vec![0.0; count], vec![0.0; count]);
        for ([before, node, after], law) in &self.beams {
            let place = place_of[*node];
            let at = |step: usize| {
                let inside = closed || (1..count - 1).contains(&place);
                inside.then(|| order[(place + step) % count])
            };
            let forwards = [Some(*before), Some(*after)] == [at(count - 1), at(1)];
            let backwards = [Some(*after), Some(*before)] == [at(count - 1), at(1)];
            if !forwards && !backwards {
                let what = format!("the beam of the nodes {before}, {node} and {after}, from 0, leaves the chain");
                return Err(SolidError::refused(what, "", "Use beams of three neighbours, the middle one second"));
            }
            let length = 0.5 * (lengths[(place + segments - 1) % segments] + lengths[place % segments]);
            let [a, b] = [*before, *after].map(|other| self.nodes[other] - self.nodes[*node]);
            (bending[place], curvatures[place]) = match *law {
                // The vector at rest points to the side to which the chain turns.
                BeamLaw::Difference(modulus, at_rest) => {
                    let along = (b - a).normalize();
                    (modulus * length.powi(3), along.perp_dot(at_rest) / length.powi(2))
                }
                BeamLaw::Product(modulus, product) => (modulus * length.powi(5), -product / length.powi(3)),
            };
            if backwards {
                curvatures[place] = -curvatures[place];
            }
        }
        let targets =
            self.targets.iter().map(|(node, stiffness)| Target::fixed(place_of[*node], self.nodes[*node], *stiffness));
        fibre
            .with_rest_lengths(&lengths)?
            .with_stretching_moduli(&stretching)?
            .with_bending_moduli(&bending)?
            .with_reference_curvatures(&curvatures)?
            .with_targets(targets)
    }
}

#[cfg(test)]
mod tests;
