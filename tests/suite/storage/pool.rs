use lcplab::storage::{Pool, Workspace, triple_product};

#[test]
fn a_pool_makes_a_buffer_only_where_none_fits() {
    let mut pool: Pool<f64> = Pool::default();
    let (small, large) = (pool.take(3), pool.take(100));
    assert_eq!((small.capacity(), large.capacity()), (4, 128)); // room to spare
    pool.give(large);
    pool.give(small);
    let small = pool.take(4);
    assert_eq!(small.capacity(), 4); // the smallest that fits
    let large = pool.take(120);
    let third = pool.take(1); // both are out
    assert_eq!((pool.takes(), pool.allocations()), (5, 3));
    pool.give(small);
    pool.give(large);
    pool.give(third);
    assert_eq!(pool.bytes(), 8 * (4 + 128 + 1));
}

#[test]
fn buffers_come_back_zeroed() {
    let mut pool = Pool::default();
    let mut buffer = pool.take(5);
    buffer.fill(7.0);
    pool.give(buffer);
    assert_eq!(pool.take(4), [0.0; 4]);
}

#[test]
fn a_warm_workspace_asks_for_nothing() {
    let mut workspace = Workspace::default();
    for kind in &lcplab::storage::ALL {
        let mut product = |rows: usize| {
            let (mut j, mut m_inv) = ((kind.new)(rows, rows), (kind.new)(rows, rows));
            let entry = |i: usize| [(i, i, 1.0), (i, i + 1, -1.0)];
            let entries: Vec<_> = (0..rows).flat_map(entry).filter(|(_, j, _)| *j < rows).collect();
            j.load(&entries).unwrap();
            m_inv.load(&(0..rows).map(|i| (i, i, 0.5)).collect::<Vec<_>>()).unwrap();
            let mut a = (kind.new)(0, 0);
            triple_product(j.as_ref(), m_inv.as_ref(), a.as_mut(), &mut workspace).unwrap();
            assert_eq!(a.row(rows - 1).unwrap(), [(rows - 2, -0.5), (rows - 1, 0.5)]);
            workspace.allocations()
        };
        let warm = product(60);
        assert!([10, 59, 31, 60].iter().all(|&rows| product(rows) == warm), "{}", kind.name);
    }
}
