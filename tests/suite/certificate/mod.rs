mod cone;
mod cross_check;
mod error_bound;
mod exact;
mod ray;
mod verdict;
