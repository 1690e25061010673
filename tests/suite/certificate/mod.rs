mod cross_check;
mod exact;
mod verdict;
