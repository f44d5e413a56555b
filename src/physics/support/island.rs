//! Islands: bodies that resting contacts connect. Walls connect nothing, since they carry no force onwards.

use super::short::Short;

/// Bodies connected by contacts, and those contacts; both ascending.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Island {
    /// Indices of the bodies, ascending.
    pub bodies: Short<usize>,
    /// Indices of the contacts, ascending.
    pub contacts: Short<usize>,
}

/// The islands of contacts given as (body, other body or wall), in the order of their first contact.
///
/// Cost O(c log c) in the contacts, whatever the number of bodies in the scene. The order depends on indices alone.
pub fn islands(contacts: &[(usize, Option<usize>)]) -> Vec<Island> {
    let bodies = touched(contacts);
    let at = |body: usize| bodies.partition_point(|&other| other < body);
    let mut parent: Short<usize> = (0..bodies.len()).collect();
    for &(a, b) in contacts {
        if let Some(b) = b {
            union(&mut parent, at(a), at(b));
        }
    }
    if (1..parent.len()).all(|local| root(&mut parent, local) == 0) && !bodies.is_empty() {
        let contacts = (0..contacts.len()).collect();
        return vec![Island { bodies, contacts }];
    }
    let mut number: Short<usize> = Short::from_elem(usize::MAX, bodies.len());
    let mut found = Vec::new();
    for (index, &(a, _)) in contacts.iter().enumerate() {
        let root = root(&mut parent, at(a));
        if number[root] == usize::MAX {
            number[root] = found.len();
            found.push(Island { bodies: Short::new(), contacts: Short::new() });
        }
        found[number[root]].contacts.push(index);
    }
    for (local, &body) in bodies.iter().enumerate() {
        let root = root(&mut parent, local);
        found[number[root]].bodies.push(body);
    }
    found
}

/// Every body that some contact names, ascending, once.
fn touched(contacts: &[(usize, Option<usize>)]) -> Short<usize> {
    let mut bodies: Short<usize> = Short::new();
    for &(a, b) in contacts {
        bodies.push(a);
        bodies.extend(b);
    }
    bodies.sort_unstable();
    bodies.dedup();
    bodies
}

/// The root of `i`, halving its path on the way.
fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

/// Joins two trees under the lower root, so that roots depend on indices alone.
fn union(parent: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(parent, a), root(parent, b));
    parent[a.max(b)] = a.min(b);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_join_nothing_and_pairs_join_what_they_touch() {
        let found = islands(&[(9, None), (4, None), (7, Some(4)), (9, None), (2, Some(7))]);
        assert_eq!(found.len(), 2);
        let island = |bodies: &[usize], contacts: &[usize]| Island { bodies: bodies.into(), contacts: contacts.into() };
        assert_eq!(found[0], island(&[9], &[0, 3]));
        assert_eq!(found[1], island(&[2, 4, 7], &[1, 2, 4]));
    }

    #[test]
    fn a_long_chain_named_backwards_is_one_island() {
        let chain: Vec<_> = (0..10_000).rev().map(|i| (i, Some(i + 1))).collect();
        let found = islands(&chain);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].bodies.to_vec(), (0..=10_000).collect::<Vec<_>>());
    }

    #[test]
    fn no_contacts_make_no_islands() {
        assert!(islands(&[]).is_empty());
    }
}
