// GY-87 (MPU6050) on an Arduino Nano: sends either protocol of docs/imu.md.
//
// Wiring: VCC 5 V, GND, SCL A5, SDA A4. Mount the board with its x axis forward and its z axis up.
// SEND_RAW 0: `its` and yaw, pitch, roll in degrees, 100 Hz at 115200 baud.
// SEND_RAW 1: gyroscope and accelerometer with CRC, 250 Hz at 500000 baud (what an ATmega328 reads and sends in time).
#include <Wire.h>
#include <math.h>
#include <string.h>

#define SEND_RAW 0

const uint8_t kAddress = 0x68;
const float kGyroScale = 1.0f / 65.5f * PI / 180.0f;  // +-500 deg/s, rad/s per count
const float kAccelScale = 9.80665f / 8192.0f;         // +-4 g, m/s^2 per count
const unsigned long kPeriod_us = SEND_RAW ? 4000 : 10000;

float gyro[3], accel[3];

void writeRegister(uint8_t reg, uint8_t value) {
  Wire.beginTransmission(kAddress);
  Wire.write(reg);
  Wire.write(value);
  Wire.endTransmission();
}

int16_t readWord() {
  const uint8_t high = Wire.read();
  return (int16_t)((high << 8) | Wire.read());
}

// True when a complete measurement came.
bool readSensor() {
  Wire.beginTransmission(kAddress);
  Wire.write(0x3B);
  Wire.endTransmission(false);
  if (Wire.requestFrom(kAddress, (uint8_t)14) != 14) return false;
  for (int i = 0; i < 3; ++i) accel[i] = readWord() * kAccelScale;
  readWord();  // temperature
  for (int i = 0; i < 3; ++i) gyro[i] = readWord() * kGyroScale;
  return true;
}

#if SEND_RAW

uint16_t sequence = 0;

uint32_t crc32(const uint8_t* data, uint8_t size) {
  uint32_t crc = 0xFFFFFFFFUL;
  for (uint8_t i = 0; i < size; ++i) {
    crc ^= data[i];
    for (uint8_t bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? 0xEDB88320UL : 0);
  }
  return ~crc;
}

// An AVR is little-endian and its float is IEEE-754: memory is already in the order of the wire.
void sendMeasurement(unsigned long time_us) {
  uint8_t frame[38] = {0xA5, 0x5A, 1, 30};
  const uint32_t time = time_us;
  memcpy(frame + 4, &sequence, 2);
  memcpy(frame + 6, &time, 4);
  memcpy(frame + 10, gyro, 12);
  memcpy(frame + 22, accel, 12);
  const uint32_t crc = crc32(frame + 2, 32);
  memcpy(frame + 34, &crc, 4);
  Serial.write(frame, sizeof frame);
  ++sequence;
}

#else

float gyroBias[3] = {0, 0, 0};
float roll = 0, pitch = 0, yaw = 0;  // rad, front-left-up

// Two seconds at rest after switching on.
void measureBias() {
  const int count = 400;
  for (int n = 0; n < count; ++n) {
    readSensor();
    for (int i = 0; i < 3; ++i) gyroBias[i] += gyro[i] / count;
    delay(5);
  }
}

// Complementary filter; enough for a robot that stays level.
void updateAngles(float dt) {
  const float w[3] = {gyro[0] - gyroBias[0], gyro[1] - gyroBias[1], gyro[2] - gyroBias[2]};
  const float rollAccel = atan2(accel[1], accel[2]);
  const float pitchAccel = atan2(-accel[0], sqrt(accel[1] * accel[1] + accel[2] * accel[2]));
  roll = 0.995f * (roll + w[0] * dt) + 0.005f * rollAccel;
  pitch = 0.995f * (pitch + w[1] * dt) + 0.005f * pitchAccel;
  yaw += w[2] * dt;
  if (yaw > PI) yaw -= 2 * PI;
  if (yaw < -PI) yaw += 2 * PI;
}

void sendAngles() {
  // The protocol's angles are front-right-down.
  const float degrees[3] = {-yaw * RAD_TO_DEG, -pitch * RAD_TO_DEG, roll * RAD_TO_DEG};
  Serial.write("its", 3);
  Serial.write((const uint8_t*)degrees, sizeof degrees);
}

#endif

void setup() {
  Serial.begin(SEND_RAW ? 500000 : 115200);
  Wire.begin();
  Wire.setClock(400000);
  writeRegister(0x6B, 0x01);  // awake, clock from the gyroscope
  writeRegister(0x1A, 0x03);  // low pass 44 Hz
  writeRegister(0x1B, 0x08);  // +-500 deg/s
  writeRegister(0x1C, 0x08);  // +-4 g
#if !SEND_RAW
  measureBias();
#endif
}

void loop() {
  static unsigned long next_us = micros();
  if ((long)(micros() - next_us) < 0) return;
  const unsigned long now_us = micros();
  next_us += kPeriod_us;
  if (!readSensor()) return;
#if SEND_RAW
  sendMeasurement(now_us);
#else
  static unsigned long last_us = now_us - kPeriod_us;
  updateAngles((now_us - last_us) * 1e-6f);
  last_us = now_us;
  sendAngles();
#endif
}
