//! Droplets that hang together.

/// Returns the sizes of the clusters of `count` droplets that pairs of their numbers join, the largest first. A droplet
/// without a partner is a cluster of one. Pairs with numbers of no droplet join nothing.
///
/// ```
/// use motile_analysis::suspension::cluster_sizes;
///
/// assert_eq!(cluster_sizes(6, &[[0, 1], [4, 1], [2, 3]]), [3, 2, 1]);
/// ```
#[must_use]
pub fn cluster_sizes(count: usize, pairs: &[[usize; 2]]) -> Vec<usize> {
    let mut parents: Vec<usize> = (0..count).collect();
    // Paths are halved on the way (Tarjan and van Leeuwen 1984).
    let root = |parents: &mut Vec<usize>, mut k: usize| {
        while parents[k] != k {
            parents[k] = parents[parents[k]];
            k = parents[k];
        }
        k
    };
    for &[a, b] in pairs.iter().filter(|pair| pair.iter().all(|&k| k < count)) {
        let [a, b] = [root(&mut parents, a), root(&mut parents, b)];
        parents[a.max(b)] = a.min(b);
    }
    let mut sizes = vec![0; count];
    for k in 0..count {
        sizes[root(&mut parents, k)] += 1;
    }
    sizes.retain(|&size| size > 0);
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes
}
