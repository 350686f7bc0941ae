#include "tools/report/gl/film.h"

#include <zlib.h>

#include <cassert>
#include <cmath>
#include <cstdint>

namespace warmjoint::report {
namespace {

constexpr std::size_t kSignature = 8;  // bytes of every PNG before its first chunk

std::string BigEndian(std::uint32_t value, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    text += static_cast<char>(value >> shift & 0xff);
  }
  return text;
}

std::uint32_t ReadBigEndian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

/// Length, type, data, checksum.
std::string Chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto checksum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return BigEndian(static_cast<std::uint32_t>(data.size()), 4) + body +
         BigEndian(static_cast<std::uint32_t>(checksum), 4);
}

/// Calls see(type, data) for every chunk of a PNG.
template <typename See>
void ForEachChunk(const std::string& png, const See& see) {
  for (std::size_t at = kSignature; at < png.size();) {
    const std::uint32_t length = ReadBigEndian(png, at);
    see(png.substr(at + 4, 4), png.substr(at + 8, length));
    at += 12 + length;
  }
}

/// fcTL: where a frame goes and how long it stays.
std::string FrameControl(std::uint32_t number, const Image& frame, double seconds) {
  const auto milliseconds = static_cast<std::uint32_t>(std::lround(1000 * seconds));
  return Chunk("fcTL", BigEndian(number, 4) +
                           BigEndian(static_cast<std::uint32_t>(frame.width), 4) +
                           BigEndian(static_cast<std::uint32_t>(frame.height), 4) +
                           BigEndian(0, 4) + BigEndian(0, 4) + BigEndian(milliseconds, 2) +
                           BigEndian(1000, 2) + BigEndian(0, 1) + BigEndian(0, 1));
}

}  // namespace

std::string EncodeFilm(const std::vector<Image>& frames, double seconds,
                       const std::string& description) {
  assert(!frames.empty());
  std::string film;
  // the still that other viewers show is no frame of the film
  const std::string still = EncodePng(frames.back(), description);
  film = still.substr(0, kSignature);
  // chunks of the still, with the number of frames behind its header
  ForEachChunk(still, [&](const std::string& type, const std::string& data) {
    if (type == "IEND") return;
    film += Chunk(type, data);
    if (type == "IHDR") {
      film +=
          Chunk("acTL", BigEndian(static_cast<std::uint32_t>(frames.size()), 4) + BigEndian(0, 4));
    }
  });
  std::uint32_t number = 0;  // of fcTL and fdAT chunks together
  // each frame is its duration and then its picture
  for (const Image& frame : frames) {
    film += FrameControl(number++, frame, seconds);
    ForEachChunk(EncodePng(frame, ""), [&](const std::string& type, const std::string& data) {
      if (type == "IDAT") film += Chunk("fdAT", BigEndian(number++, 4) + data);
    });
  }
  return film + Chunk("IEND", "");
}

}  // namespace warmjoint::report
