// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/lcm_url.hpp"

#include <gmock/gmock.h>

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(LcmUrl, TheDefaultIsThisMachineOnly) {
  const Result<LcmUrl> url = parse_lcm_url("udpm://239.255.76.67:7667?ttl=0");
  ASSERT_TRUE(url.ok());
  EXPECT_EQ(url->provider, LcmUrl::Provider::kMulticast);
  EXPECT_EQ(url->group, "239.255.76.67");
  EXPECT_EQ(url->port, 7667);
  EXPECT_EQ(url->ttl, 0);
}

TEST(LcmUrl, WhatIsLeftOutKeepsItsDefault) {
  const Result<LcmUrl> bare = parse_lcm_url("udpm://");
  ASSERT_TRUE(bare.ok());
  EXPECT_EQ(bare->group, "239.255.76.67");
  const Result<LcmUrl> options = parse_lcm_url("udpm://224.1.2.3?recv_buf_size=100000&ttl=1");
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options->group, "224.1.2.3");
  EXPECT_EQ(options->port, 7667);
  EXPECT_EQ(options->ttl, 1);
}

TEST(LcmUrl, OtherProvidersDoNotConcernTheNetwork) {
  for (const char* text : {"file://run.lcm?mode=w", "tcpq://localhost", "memq://"}) {
    const Result<LcmUrl> url = parse_lcm_url(text);
    ASSERT_TRUE(url.ok()) << text;
    EXPECT_EQ(url->provider, LcmUrl::Provider::kOther) << text;
  }
}

TEST(LcmUrl, NamesTheFileOfALog) {
  EXPECT_EQ(parse_lcm_url("file://run.lcm")->file, "run.lcm");
  EXPECT_EQ(parse_lcm_url("file:///tmp/run.lcm?mode=w")->file, "/tmp/run.lcm");
  EXPECT_EQ(parse_lcm_url("tcpq://localhost")->file, "");
}

TEST(LcmUrl, ALogIsReadWhereNothingSaysThatItIsWritten) {
  for (const char* read : {"file://mode=w", "file://run.lcm", "file://run.lcm?mode=r&speed=0"})
    EXPECT_FALSE(parse_lcm_url(read)->writes_file) << read;
  for (const char* written : {"file://run.lcm?mode=w", "file://run.lcm?speed=0&mode=a"})
    EXPECT_TRUE(parse_lcm_url(written)->writes_file) << written;
}

TEST(LcmUrl, RefusesWhatLcmCannotUse) {
  const auto message = [](const std::string& text) {
    const Result<LcmUrl> url = parse_lcm_url(text);
    return url ? std::string("accepted") : url.error().message;
  };
  EXPECT_THAT(message("239.255.76.67:7667"), AllOf(HasSubstr("must begin with udpm://"), HasSubstr("ttl=0")));
  EXPECT_THAT(message("udpm://192.168.1.1:7667"), HasSubstr("'192.168.1.1' is no multicast address"));
  EXPECT_THAT(message("udpm://somewhere:7667"), HasSubstr("no multicast address"));
  EXPECT_THAT(message("udpm://239.255.76.67:0"), HasSubstr("port"));
  EXPECT_THAT(message("udpm://239.255.76.67:7667x"), HasSubstr("port"));
  EXPECT_THAT(message("udpm://239.255.76.67:7667?ttl=256"), HasSubstr("ttl must be"));
  EXPECT_THAT(message("udpm://239.255.76.67:7667?ttl"), HasSubstr("ttl must be"));
  EXPECT_THAT(message("udpm://239.255.76.67:7667?ttl=0&hops=1"), HasSubstr("unknown option 'hops'"));
}

}  // namespace
}  // namespace swiftlet
