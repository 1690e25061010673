//! The chapter's listings as printed (`printed`), each beside its corrected form (`corrected`).

pub mod code08_matrix_program;
pub mod code09_10_dense_matrix;
pub mod code11_map_matrix;
