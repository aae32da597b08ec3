#include "reports/campaigns/ranks.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <mpi.h>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

constexpr const char* size_variable = "OMPI_COMM_WORLD_SIZE";
constexpr const char* rank_variable = "OMPI_COMM_WORLD_RANK";

std::uint64_t number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  std::uint64_t value = 0;
  const char* const end = text ? text + std::strlen(text) : nullptr;
  if (!text || std::from_chars(text, end, value).ptr != end) {
    throw InvalidInput(variable, text ? text : "unset", "must be the number that mpirun gives");
  }
  return value;
}

/// MPI counts bytes in int.
constexpr std::size_t piece = 1 << 30;

void send(const std::string& text) {
  const std::uint64_t size = text.size();
  MPI_Send(&size, 1, MPI_UINT64_T, 0, 0, MPI_COMM_WORLD);
  for (std::size_t at = 0; at < text.size(); at += piece) {
    MPI_Send(text.data() + at, static_cast<int>(std::min(piece, text.size() - at)), MPI_BYTE, 0, 0,
             MPI_COMM_WORLD);
  }
}

std::string receive(int rank) {
  std::uint64_t size = 0;
  MPI_Recv(&size, 1, MPI_UINT64_T, rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  std::string text(size, '\0');
  for (std::size_t at = 0; at < text.size(); at += piece) {
    MPI_Recv(text.data() + at, static_cast<int>(std::min(piece, text.size() - at)), MPI_BYTE, rank,
             0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }
  return text;
}

/// What is called by every rank.
bool exchange(const Progressed& part, Merge& merge) {
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (rank != 0) {
    send(to_text(part));
    return false;
  }
  merge.add(part, "rank 0");
  for (int other = 1; other < size; ++other) {
    const std::string name = fmt::format("rank {}", other);
    merge.add(progressed_from_text(receive(other), name), name);
  }
  return true;
}

}  // namespace

bool under_mpirun() { return std::getenv(size_variable) != nullptr; }

Shard shard_of_rank() {
  if (!under_mpirun()) return {};
  const std::uint64_t rank = number_in(rank_variable), size = number_in(size_variable);
  if (rank >= size) {
    throw InvalidInput(rank_variable, fmt::format("{}", rank),
                       fmt::format("must be less than {}, which is {}", size_variable, size));
  }
  return {rank + 1, size};
}

bool gather(const Progressed& part, Merge& merge) {
  MPI_Init(nullptr, nullptr);
  try {
    const bool first = exchange(part, merge);
    MPI_Finalize();
    return first;
  } catch (const std::exception& e) {
    // The other ranks would wait for ever.
    std::fputs(fmt::format("error: {}\n", e.what()).c_str(), stderr);
    MPI_Abort(MPI_COMM_WORLD, 2);
    throw;
  }
}

}  // namespace touchstone
