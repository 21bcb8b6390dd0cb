#pragma once

/// \file ranks.hpp
/// \brief Processes that make one picture together by MPI.

#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <mpi.h>

#include "command_line.hpp"
#include "same_picture.hpp"

namespace examples {

/// One of several processes that share a job.
struct Rank {
    int number = 0;   ///< The number of this process, from 0.
    int count = 1;    ///< The number of processes.
    bool met = false; ///< Whether this process has called agree().
};

// Whether all ranks are ready for the work. Each rank calls this once.
inline bool all_come(Rank& rank, bool this_one) {
    rank.met = true;
    int all = this_one ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    return all == 1;
}

/// Makes sure that all ranks are ready and make the same picture.
/// \param rank     This rank.
/// \param picture  The picture_text() of this rank.
/// \throws std::runtime_error  if a rank has ended, or if the picture differs from that
///         of rank 0.
inline void agree(Rank& rank, const std::string& picture) {
    if (!all_come(rank, true))
        throw std::runtime_error("another rank has ended before the work began");
    std::string first = picture;
    int letters = static_cast<int>(first.size());
    MPI_Bcast(&letters, 1, MPI_INT, 0, MPI_COMM_WORLD);
    first.resize(static_cast<std::size_t>(letters));
    MPI_Bcast(first.data(), letters, MPI_CHAR, 0, MPI_COMM_WORLD);
    if (const std::string why = difference(picture, first); !why.empty())
        throw std::runtime_error("rank " + std::to_string(rank.number) +
                                 " is to make another picture than rank 0: " + why);
}

/// Sends each rank a list, and receives one from each.
/// \param lists     One list for each rank, with values that can be copied byte by
///                  byte.
/// \param received  If not null, receives the number of values from each rank.
/// \return All values received, in the order of the ranks that sent them.
template <typename T>
std::vector<T> all_to_all(const std::vector<std::vector<T>>& lists,
                          std::vector<int>* received = nullptr) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<int> out(lists.size()), in(lists.size());
    std::vector<int> out_at(lists.size() + 1, 0), in_at(lists.size() + 1, 0);
    std::vector<T> sent;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        out[i] = static_cast<int>(lists[i].size());
        sent.insert(sent.end(), lists[i].begin(), lists[i].end());
    }
    MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::partial_sum(out.begin(), out.end(), out_at.begin() + 1);
    std::partial_sum(in.begin(), in.end(), in_at.begin() + 1);
    std::vector<T> all(static_cast<std::size_t>(in_at.back()));
    MPI_Datatype value = MPI_DATATYPE_NULL; // MPI counts in int, so values are counted,
                                            // not bytes
    MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &value);
    MPI_Type_commit(&value);
    MPI_Alltoallv(sent.data(), out.data(), out_at.data(), value, all.data(), in.data(),
                  in_at.data(), value, MPI_COMM_WORLD);
    MPI_Type_free(&value);
    if (received) *received = in;
    return all;
}

/// The main() of a program of several ranks. It is run_main() with a body that receives
/// the command line and the rank of the process, and calls agree() before the work. No
/// rank waits for a rank that has failed or has only printed --help.
template <typename Body>
int run_ranks(int argc, char** argv, Body&& body) {
    int threads = 0; // only one thread uses MPI
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
    Rank rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank.number);
    MPI_Comm_size(MPI_COMM_WORLD, &rank.count);
    const int code = run_main(argc, argv, [&](CommandLine& line) { body(line, rank); });
    if (code != 0) MPI_Abort(MPI_COMM_WORLD, code); // the reason was printed
    if (!rank.met) (void)all_come(rank, false);
    MPI_Finalize();
    return code;
}

} // namespace examples
