mod cone;
mod cross_check;
mod error_bound;
mod exact;
mod friction;
mod motion_bound;
mod ray;
mod verdict;
