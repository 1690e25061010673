//! The number of nodes in a sorted map of the standard library, and their sizes.
//!
//! A B-tree node has room for 11 pairs, and for 12 links to child nodes unless it is a leaf. Pairs
//! in ascending order fill the rightmost leaf; the 12th splits it: 6 stay, one moves up, 5 begin
//! the next leaf, which is full 6 pairs later. Therefore, level by level from the leaves,
//!
//! ```text
//! nodes(k) = 1 + ⌊(k − 5) / 7⌋  for k ≥ 12 pairs,  1 below;    pairs above = nodes − 1
//! ```
//!
//! In another order nodes split elsewhere, and there can be a quarter fewer or more.

/// The number of pairs that fit into a node.
const ROOM: usize = 11;

/// The number of leaves and inner nodes of a map with this number of pairs, set in ascending order.
pub(super) fn nodes(mut pairs: usize) -> (usize, usize) {
    let (mut leaves, mut inner) = (0, 0);
    while pairs > 0 {
        let level = if pairs > ROOM { 1 + (pairs - 5) / 7 } else { 1 };
        if leaves == 0 {
            leaves = level;
        } else {
            inner += level;
        }
        pairs = level - 1;
    }
    (leaves, inner)
}

/// The bytes of a map with this number of pairs of K and V, set in ascending order.
pub(super) fn bytes<K, V>(pairs: usize) -> usize {
    // The pointer to the parent node, the index in it, the number of pairs.
    let header = size_of::<usize>() + 2 * size_of::<u16>();
    let leaf = header + ROOM * (size_of::<K>() + size_of::<V>());
    let align = align_of::<usize>().max(align_of::<K>()).max(align_of::<V>());
    let leaf = leaf.next_multiple_of(align);
    let (leaves, inner) = nodes(pairs);
    leaves * leaf + inner * (leaf + (ROOM + 1) * size_of::<usize>())
}
