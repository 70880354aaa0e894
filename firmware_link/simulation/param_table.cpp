// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/param_table.hpp"

#include <boost/crc.hpp>
#include <vector>

#include "core/base/check.hpp"
#include "firmware_link/simulation/members.hpp"

namespace swiftlet {
namespace {

using enum ParamType;
constexpr std::uint8_t kCore = kParamCore;
constexpr std::uint8_t kStored = kParamPersistent;
constexpr std::uint8_t kFixed = kParamReadOnly;

/// Parameters of one group with the same type and flags; `members`: names, each with its default value
/// unless that is 0.
struct ParamFamily {
  std::string_view group;
  ParamType type;
  unsigned flags;
  std::string_view members;
};

constexpr ParamFamily kFamilies[] = {
    {"deck", kUint8, kCore | kFixed,
     "bcFlow2 bcMultiranger bcZRanger2 bcFlow bcZRanger bcLighthouse4 bcLoco bcDWM1000 bcActiveMarker bcAI "
     "bcBuzzer "
     "bcLedRing bcUSD bcBigQuad bcServo bcACS37800"},
    {"deck", kUint8, kFixed, "bcOA bcCPPM bcGTGPS"},
    {"stabilizer", kUint8, kCore, "estimator controller=1 stop"},
    {"kalman", kUint8, kCore, "resetEstimation robustTdoa robustTwr"},
    {"kalman", kFloat, kCore | kStored,
     "pNAcc_xy=0.5 pNAcc_z=1 pNVel pNPos pNAtt mNBaro=2 mNGyro_rollpitch=0.1 mNGyro_yaw=0.1"},
    {"kalman", kFloat, kCore, "initialX initialY initialZ initialYaw"},
    {"kalman", kFloat, 0, "maxPos=100 maxVel=10 attReversion=0.001"},
    {"multiranger", kUint16, 0, "filterMask=1"},
    {"motion", kUint8, 0, "disable adaptive"},
    {"motion", kFloat, kCore, "flowStdFixed=2"},
    {"pm", kFloat, kCore | kStored, "lowVoltage=3.2 criticalLowVoltage=3"},
    {"system", kInt8, kCore | kFixed, "selftestPassed=1"},
    {"system", kUint8, kCore, "taskDump"},
    {"system", kUint8, 0, "assertInfo testLogParam doAssert storageStats storageReformat"},
    {"crtpsrv", kUint16, 0, "echoDelay"},
    {"commander", kUint8, kCore, "enHighLevel=1"},
    {"firmware", kUint32, kCore | kFixed, "revision0=1 modified"},
    {"firmware", kUint16, kCore | kFixed, "revision1"},
    {"cpu", kUint16, kCore | kFixed, "flash=1024"},
    {"cpu", kUint32, kCore | kFixed, "id0=1 id1=2 id2=3"},
    {"imu_sensors", kUint8, kFixed, "BMP3XX=1 BMM150 BMI088=1 AK8963 LPS25H"},
    {"imu_tests", kUint8, kFixed, "MPU6500 AK8963 LPS25H"},
    {"imu_sensors", kFloat, kCore | kStored, "imuPhi imuTheta imuPsi"},
    {"flightmode", kUint8, kCore, "althold poshold posSet stabModeRoll=1 stabModePitch=1 stabModeYaw"},
    {"flightmode", kUint8, 0, "yawMode"},
    {"cmdrCPPM", kFloat, kCore, "rateRoll=720 ratePitch=720 rateYaw=400 angRoll=50 angPitch=50"},
    {"pid_attitude", kFloat, kStored,
     "roll_kp=6 roll_ki=3 roll_kd roll_kff pitch_kp=6 pitch_ki=3 pitch_kd pitch_kff yaw_kp=6 yaw_ki=1 "
     "yaw_kd=0.35 "
     "yaw_kff"},
    {"pid_attitude", kInt8, kStored, "attFiltEn"},
    {"pid_attitude", kFloat, kStored, "attFiltCut=15 yawMaxDelta"},
    {"pid_rate", kFloat, kStored,
     "roll_kp=250 roll_ki=500 roll_kd=2.5 roll_kff pitch_kp=250 pitch_ki=500 pitch_kd=2.5 pitch_kff "
     "yaw_kp=120 "
     "yaw_ki=16.7 yaw_kd yaw_kff"},
    {"pid_rate", kInt8, kStored, "rateFiltEn"},
    {"pid_rate", kFloat, kStored, "omxFiltCut=30 omyFiltCut=30 omzFiltCut=30"},
    {"velCtlPid", kFloat, kStored,
     "vxKp=25 vxKi=1 vxKd vxKFF vyKp=25 vyKi=1 vyKd vyKFF vzKp=22 vzKi=15 vzKd vzKFF"},
    {"posCtlPid", kFloat, kStored,
     "xKp=2 xKi xKd xKff yKp=2 yKi yKd yKff zKp=2 zKi=0.5 zKd zKff xVelMax=1 yVelMax=1 zVelMax=1 rLimit=20 "
     "pLimit=20"},
    {"posCtlPid", kUint16, kStored, "thrustBase=36000 thrustMin=20000"},
    {"ctrlMel", kFloat, kCore | kStored,
     "kp_xy=0.4 kd_xy=0.2 ki_xy=0.05 i_range_xy=2 kp_z=1.25 kd_z=0.4 ki_z=0.05 i_range_z=0.4 mass=0.032 "
     "massThrust=132000 kR_xy=70000 kR_z=60000 kw_xy=20000 kw_z=12000 ki_m_xy ki_m_z=500 kd_omega_rp=200 "
     "i_range_m_xy=1 i_range_m_z=1500"},
    {"ctrlINDI", kFloat, 0,
     "thrust_threshold=300 bound_ctrl_input=32000 g1_p=0.0066 g1_q=0.0062 g1_r=0.0014 g2=0.0001 ref_err_p=24 "
     "ref_err_q=24 ref_err_r=24 ref_rate_p=14 ref_rate_q=14 ref_rate_r=14 act_dyn_p=0.03 act_dyn_q=0.03 "
     "act_dyn_r=0.03 filt_cutoff=8 filt_cutoff_r=8"},
    {"ctrlINDI", kUint8, 0, "outerLoopActive"},
    {"controller", kFloat, 0, "tiltComp"},
    {"posEstAlt", kFloat, kCore,
     "estAlphaAsl=0.997 estAlphaZr=0.9 velFactor=1 velZAlpha=0.995 vAccDeadband=0.04"},
    {"sensfusion6", kFloat, kCore, "kp=0.8 ki=0.002 baseZacc=1"},
    {"hlCommander", kFloat, kCore, "vtoff=0.5 vland=0.5"},
    {"colAv", kUint8, 0, "enable"},
    {"colAv", kFloat, 0,
     "ellipsoidX=0.3 ellipsoidY=0.3 ellipsoidZ=0.9 bboxMinX=-1000 bboxMinY=-1000 bboxMinZ=-1000 "
     "bboxMaxX=1000 "
     "bboxMaxY=1000 bboxMaxZ=1000 horizon=1 maxSpeed=0.5 sidestepThrsh=0.25 vorTol=0.00001"},
    {"colAv", kInt32, 0, "maxPeerLocAge=5000 vorIters=100"},
    {"health", kUint8, kCore, "startPropTest startBatTest"},
    {"health", kUint16, kCore, "propTestPWMRatio batTestPWMRatio=40000"},
    {"motorPowerSet", kUint8, kCore, "enable"},
    {"motorPowerSet", kUint16, kCore, "m1 m2 m3 m4"},
    {"powerDist", kUint32, kCore | kStored, "idleThrust"},
    {"quadSysId", kFloat, 0,
     "armLength=0.046 thrustToTorque=0.00594 pwmToThrustA=0.091492 pwmToThrustB=0.067673"},
    {"supervisor", kUint8, 0, "infdmp"},
    {"supervisor", kUint8, kStored, "tmblChckEn=1"},
    {"supervisor", kUint16, kStored, "prefltTimeout=2000 landedTimeout=3000"},
    {"led", kUint8, kCore, "bitmask"},
    {"ring", kUint8, kCore | kStored, "effect=6"},
    {"ring", kUint32, kCore | kFixed, "neffect=18"},
    {"ring", kUint8, kCore, "solidRed=20 solidGreen=20 solidBlue=20 headlightEnable"},
    {"ring", kFloat, kCore, "emptyCharge=3.1 fullCharge=4.2 fadeTime=0.5"},
    {"ring", kUint32, kCore, "fadeColor"},
    {"sound", kUint8, kCore, "effect"},
    {"sound", kUint32, kCore | kFixed, "neffect=13"},
    {"sound", kUint16, kCore, "freq=4000"},
    {"loco", kUint8, kCore | kStored, "mode"},
    {"tdoa2", kFloat, kCore, "stddev=0.15"},
    {"tdoa3", kFloat, kCore, "stddev=0.15"},
    {"tdoaEngine", kUint8, kCore, "logId logOthrId matchAlgo=2"},
    {"lighthouse", kUint8, kCore, "method enLhRawStream"},
    {"lighthouse", kUint16, kCore, "bsCalibReset systemType=2 bsAvailable"},
    {"lighthouse", kFloat, 0, "sweepStd=0.0004 sweepStd2=0.001"},
    {"locSrv", kUint8, kCore, "enRangeStreamFP32 enLhAngleStream"},
    {"locSrv", kFloat, kCore, "extPosStdDev=0.01 extQuatStdDev=0.0045"},
    {"usd", kUint8, kCore, "canLog logging"},
    {"memTst", kUint8, 0, "resetW"},
    {"activeMarker", kUint8, kCore, "front=1 back=3 left=4 right=2 mode=3 poll"},
    {"BigQuad", kUint8, 0, "lowBattery"},
    {"vl53l1", kUint8, 0, "budget"},
    {"estimator", kFloat, 0, "baroZRef"},
};

std::vector<ParamDescription> make_param_table() {
  std::vector<ParamDescription> table;
  for (const ParamFamily& family : kFamilies)
    for_each_member(family.members, [&](std::string_view name, double default_value) {
      table.push_back(
          {family.group, name, family.type, static_cast<std::uint8_t>(family.flags), default_value});
    });
  return table;
}

}  // namespace

std::size_t param_type_size(ParamType type) {
  switch (type) {
    case kInt8:
    case kUint8:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kInt32:
    case kUint32:
    case kFloat:
      return 4;
    case kInt64:
    case kUint64:
    case kDouble:
      return 8;
  }
  return 0;
}

std::span<const ParamDescription> simulated_param_table() {
  static const std::vector<ParamDescription> kTable = make_param_table();
  return kTable;
}

std::uint16_t simulated_param_id(std::string_view group, std::string_view name) {
  const std::span<const ParamDescription> table = simulated_param_table();
  for (std::size_t id = 0; id < table.size(); ++id)
    if (table[id].group == group && table[id].name == name) return static_cast<std::uint16_t>(id);
  SWIFTLET_CHECK(false, "the simulation asks for parameters that it has");
  return 0;
}

std::uint32_t simulated_param_table_crc() {
  boost::crc_32_type crc;
  for (const ParamDescription& param : simulated_param_table()) {
    crc.process_byte(static_cast<unsigned char>(static_cast<unsigned>(param.type) | param.flags));
    crc.process_bytes(param.group.data(), param.group.size());
    crc.process_byte(0);
    crc.process_bytes(param.name.data(), param.name.size());
    crc.process_byte(0);
  }
  return crc.checksum();
}

}  // namespace swiftlet
