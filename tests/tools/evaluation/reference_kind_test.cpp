// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/reference_kind.hpp"

#include <gmock/gmock.h>

#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

Result<ReferenceKind> kind_of(const std::string& name, const std::string& text) {
  return recognise_reference(TemporaryFile(name, text).path());
}

TEST(ReferenceKind, IsTruthWhereEachLineEndsInARotation) {
  EXPECT_EQ(*kind_of("unix_time.txt",
                     "1627252327.5 0.78 -0.27 0 0 0 -0.0517644 0.9986593\n"
                     "1627252327.6 0.85 -0.27 0 0 0 -0.0472829 0.9988815\n"),
            ReferenceKind::kTruth);
  EXPECT_EQ(*kind_of("from_zero.txt", "0.5 0.7 0 0 0 0 0 1\n0.6 0.1 0 0 0 0 0 1\n"), ReferenceKind::kTruth);
}

TEST(ReferenceKind, IsRelationsWhereEachLineHasTwoStampsInWhicheverOrder) {
  EXPECT_EQ(*kind_of("a.txt", "# t1 t2\n905.1 911.8 -0.05 -0.1 0 0 0 -1.6\n896.7 905.1 -0.1 0 0 0 0 -2.4\n"),
            ReferenceKind::kRelations);
  EXPECT_EQ(*kind_of("b.txt", "905 911 0 0 0 0 0 0.5\n911 905 0 0 0 0 0 -1.0\n"), ReferenceKind::kRelations);
}

TEST(ReferenceKind, IsSettledByTheNameOfRelations) {
  const char* either = "5 6 1 0 0 0 0 1\n";
  EXPECT_EQ(*kind_of("either.relations", either), ReferenceKind::kRelations);
  EXPECT_EQ(*kind_of("either.relations.gz", either), ReferenceKind::kRelations);
  EXPECT_THAT(
      kind_of("either.txt", either).error().message,
      HasSubstr("may be relations (two stamps in each line) or a TUM trajectory (a unit quaternion in "
                "each line); say which with --relations or --truth"));
}

TEST(ReferenceKind, IsUndecidableWhereOneLineSpeaksAgainstEach) {
  EXPECT_THAT(kind_of("neither.txt", "5 0.2 1 0 0 0 0 1\n6 7 1 0 0 0 0 0.3\n").error().message,
              HasSubstr("neither a TUM trajectory (no unit quaternion in line 2) nor relations (no second "
                        "stamp in line 1); if it is one, say which with --relations or --truth"));
}

TEST(ReferenceKind, IsAFlightWhereItBeginsLikeACaptureOrIsNamedSo) {
  EXPECT_EQ(*kind_of("flight", "\xD4\xC3\xB2\xA1 and so on"), ReferenceKind::kFlight);
  EXPECT_EQ(*kind_of("broken.pcap", "1 2 3"), ReferenceKind::kFlight);
}

TEST(ReferenceKind, OfWhatCannotBeReadIsAnError) {
  EXPECT_EQ(recognise_reference("/nonexistent/a.relations").error().code, ErrorCode::kNotFound);
  EXPECT_THAT(kind_of("log.clf", "FLASER 180 1 2\n").error().message, HasSubstr("log.clf:1: column 1"));
}

}  // namespace
}  // namespace swiftlet
