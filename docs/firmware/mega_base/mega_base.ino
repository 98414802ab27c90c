// Base of four driven wheels, which may be steered, on an Arduino Mega 2560: the protocol of docs/base.md at 500000 baud, a speed loop
// for each wheel and an angle loop for each steered axis, a servo, two TFmini range finders, two switches, the battery, a motor.
// Not tried on hardware.
//
// Everything but the pins is in src/ (a link to src/sensors/base/controller: copy the folder where your system has no links), which
// the emulator and the tests run, too. The registers are used directly, since the timers have to make 20 kHz: open it in the
// Arduino IDE as it is, or compile it with avr-g++ and avr-libc alone, as test/firmware does.
//
// | what | pins of the wheels 1 to 4 |
// |---|---|
// | encoder, A and B | 21 and 22, 20 and 23, 19 and 24, 18 and 25 |
// | motor driver, PWM (20 kHz) and direction | 6 and 26, 7 and 27, 8 and 28, 46 and 29 |
// | where steered: its motor driver, PWM (20 kHz) and direction | 5 and 36, 2 and 35, 3 and 34, 44 and 33 |
// | where steered: absolute sensor of the axis, 0 to 5 V in a turn | A1, A2, A3, A4 |
//
// Motor of the actuator: PWM 45, direction 32. Servo: 11. TFmini: TX to 17 and to 15. Switches: 30 and 31, to ground. Battery: A0,
// behind 33 kOhm and 10 kOhm. Each PWM pin gets 10 kOhm to ground, so that the motors stand while the controller starts. A switch
// that cuts the motors' supply is no matter of software: build one in.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>
#include <util/atomic.h>

#include "src/base_controller.h"
#include "src/tfmini.h"

using namespace stereo_nav::base;

// ---- Your base -------------------------------------------------------------------------------------------------------------
static const uint8_t kWheels = 4, kJoints = 1, kRanges = 2, kActuators = 1;
// Circumference divided by the pulses of a turn, as in the rig file; negative where a wheel counts down when it rolls forwards.
// Both edges of A are counted: twice the lines of the encoder, times the gear.
static const float kMetresPerPulse[kWheels] = {0.000307F, 0.000307F, 0.000307F, 0.000307F};
static const bool kMotorReversed[kWheels] = {false, true, false, true};
// A swerve drive has four steered wheels, a car two. The axis turns counterclockwise, seen from above, where its sensor's voltage rises
// or, reversed, falls; kSteeringZero is what the sensor reads, 0 to 1023, where the wheel looks forward.
static const bool kSteered[kWheels] = {false, false, false, false};
static const bool kSteeringSensorReversed[kWheels] = {false, false, false, false};
static const bool kSteeringMotorReversed[kWheels] = {false, false, false, false};
static const uint16_t kSteeringZero[kWheels] = {0, 0, 0, 0};
// Find the first two with the wheels in the air: friction_duty just turns a wheel, (duty - friction_duty) / speed is
// duty_per_speed. Raise `proportional` until the wheel hums, and halve it.
static const SpeedLoopGains kGains = {0.5F, 0.05F, 1.5F, 3.0F, 10.0F};
// Of the steered axes, likewise, with rad/s in place of m/s. 15: the axis shall turn by 15 rad/s for each radian that is missing, at most
// by 8; within 0.008 rad, above a step of the sensor, it rests.
static const SteeringLoopGains kSteeringGains = {15.0F, 8.0F, 0.008F, {0.083F, 0.05F, 0.1F, 2.0F, 10.0F}};
static const float kServoMicroradPerTick = 785.4F;  // of 0.5 us; 90 degrees for 1 ms
static const float kBatteryMillivoltsPerCount = 5000.0F / 1024.0F * 4.3F;
static const TfminiLimits kRangeLimits = {100, 12000, 100};  // TFmini Plus: mm, mm, least strength
// -----------------------------------------------------------------------------------------------------------------------------

static const uint16_t kPwmTop = 400;      // 16 MHz / 2 / 400 = 20 kHz
static const uint16_t kServoMiddle = 3000;  // 1.5 ms
static const uint8_t kPeriod_ms = 10;

static volatile int32_t pulses[kWheels];
static volatile uint32_t milliseconds;

// A turns: forwards where it now equals B.
static void count(uint8_t wheel, bool a, bool b) { pulses[wheel] += a == b ? 1 : -1; }
ISR(INT0_vect) { count(0, PIND & _BV(0), PINA & _BV(0)); }
ISR(INT1_vect) { count(1, PIND & _BV(1), PINA & _BV(1)); }
ISR(INT2_vect) { count(2, PIND & _BV(2), PINA & _BV(2)); }
ISR(INT3_vect) { count(3, PIND & _BV(3), PINA & _BV(3)); }
ISR(TIMER2_COMPA_vect) { ++milliseconds; }

// Bytes that wait between an interrupt and the loop. 256 of them: the indices wrap by themselves.
struct Ring {
  volatile uint8_t bytes[256];
  volatile uint8_t head, tail;
  bool empty() const { return head == tail; }
  void put(uint8_t byte) {
    if (static_cast<uint8_t>(head + 1) == tail) return;  // full: the check sum finds the gap
    bytes[head] = byte;
    head = static_cast<uint8_t>(head + 1);
  }
  uint8_t take() {
    const uint8_t byte = bytes[tail];
    tail = static_cast<uint8_t>(tail + 1);
    return byte;
  }
};
static Ring received, to_send;

ISR(USART0_RX_vect) { received.put(UDR0); }
ISR(USART0_UDRE_vect) {
  if (to_send.empty()) {
    UCSR0B &= static_cast<uint8_t>(~_BV(UDRIE0));
  } else {
    UDR0 = to_send.take();
  }
}

static Tfmini finders[kRanges] = {Tfmini(kRangeLimits), Tfmini(kRangeLimits)};

ISR(USART2_RX_vect) { finders[0].receive(UDR2, milliseconds); }
ISR(USART3_RX_vect) { finders[1].receive(UDR3, milliseconds); }

// The battery on A0 and the steering sensors on A1 to A4, in turn: each every 0.5 ms.
static const uint8_t kAnalogInputs = 1 + kWheels;
static volatile uint16_t analog[kAnalogInputs];

ISR(ADC_vect) {
  static uint8_t input = 0;
  analog[input] = ADC;
  input = static_cast<uint8_t>((input + 1) % kAnalogInputs);
  ADMUX = static_cast<uint8_t>(_BV(REFS0) | input);
  ADCSRA |= _BV(ADSC);
}

static TurnCounter turns[kWheels];

static int32_t steeringAngle(uint8_t wheel, uint16_t counts) {
  static const uint16_t kCountsPerTurn = 1024;
  if (!kSteered[wheel]) return 0;
  const int32_t angle_urad = turns[wheel].angle_urad(counts, kSteeringZero[wheel], kCountsPerTurn);
  return kSteeringSensorReversed[wheel] ? -angle_urad : angle_urad;
}

static ControllerSetup describeBase() {
  ControllerSetup setup = ControllerSetup();
  setup.wheels = kWheels;
  setup.joints = kJoints;
  setup.ranges = kRanges;
  setup.actuators = kActuators;
  for (uint8_t i = 0; i < kWheels; ++i) {
    setup.metres_per_pulse[i] = kMetresPerPulse[i];
    setup.is_steered[i] = kSteered[i];
  }
  setup.gains = kGains;
  setup.steering_gains = kSteeringGains;
  return setup;
}

static BaseController controller((describeBase()));
static ControllerOutputs outputs = ControllerOutputs();

static ControllerInputs measure() {
  ControllerInputs inputs = ControllerInputs();
  uint16_t read[kAnalogInputs];
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    for (uint8_t i = 0; i < kWheels; ++i) inputs.pulses[i] = pulses[i];
    for (uint8_t i = 0; i < kRanges; ++i) inputs.range_mm[i] = finders[i].range_mm(milliseconds);
    for (uint8_t i = 0; i < kAnalogInputs; ++i) read[i] = analog[i];
  }
  for (uint8_t i = 0; i < kWheels; ++i) inputs.steering_urad[i] = steeringAngle(i, read[1 + i]);
  inputs.joint_urad[0] = outputs.joint_urad[0];  // a servo does not tell where it is
  inputs.switches = static_cast<uint16_t>((PINC & _BV(7) ? 0 : 1) | (PINC & _BV(6) ? 0 : 2));
  inputs.battery_mV = static_cast<uint16_t>(read[0] * kBatteryMillivoltsPerCount);
  return inputs;
}

static void setPin(volatile uint8_t& port, uint8_t bit, bool high) {
  port = static_cast<uint8_t>(high ? port | _BV(bit) : port & ~_BV(bit));
}

static uint16_t dutyTicks(float duty) { return static_cast<uint16_t>((duty < 0.0F ? -duty : duty) * kPwmTop); }

static void setMotor(uint8_t wheel, float duty) {
  volatile uint16_t* const compare[kWheels] = {&OCR4A, &OCR4B, &OCR4C, &OCR5A};
  setPin(PORTA, static_cast<uint8_t>(4 + wheel), (duty < 0.0F) != kMotorReversed[wheel]);
  *compare[wheel] = dutyTicks(duty);
}

static void setSteeringMotor(uint8_t wheel, float duty) {
  volatile uint16_t* const compare[kWheels] = {&OCR3A, &OCR3B, &OCR3C, &OCR5C};
  setPin(PORTC, static_cast<uint8_t>(1 + wheel), (duty < 0.0F) != kSteeringMotorReversed[wheel]);
  *compare[wheel] = dutyTicks(duty);
}

static void act() {
  for (uint8_t i = 0; i < kWheels; ++i) {
    setMotor(i, outputs.duty[i]);
    setSteeringMotor(i, outputs.steering_duty[i]);
  }
  const float level = 1e-3F * outputs.actuator_permille[0];
  setPin(PORTC, 5, level < 0.0F);
  OCR5B = dutyTicks(level);
  const float ticks = kServoMiddle + outputs.joint_urad[0] / kServoMicroradPerTick;
  OCR1A = ticks < 1000.0F ? 1000 : ticks > 5000.0F ? 5000 : static_cast<uint16_t>(ticks);
}

static void send(const ControllerInputs& inputs, uint32_t now_ms) {
  static uint8_t frame[maxFrameBytes<Telemetry>()];
  const size_t size = controller.telemetry(inputs, 1000 * now_ms, frame);
  for (size_t i = 0; i < size; ++i) to_send.put(frame[i]);
  UCSR0B |= _BV(UDRIE0);
}

static void setUpSerial() {
  UCSR0A = _BV(U2X0);
  UBRR0 = 3;  // 500000 baud, exactly
  UCSR0B = _BV(RXCIE0) | _BV(RXEN0) | _BV(TXEN0);
  UCSR2A = _BV(U2X2);
  UCSR3A = _BV(U2X3);
  UBRR2 = UBRR3 = 16;  // 115200 baud and 2 %
  UCSR2B = _BV(RXCIE2) | _BV(RXEN2);
  UCSR3B = _BV(RXCIE3) | _BV(RXEN3);
}

static void setUpTimers() {
  // 3, 4 and 5: phase correct up to ICR, no prescaler. 1: servo, 20 ms of 0.5 us. 2: 1 ms.
  ICR3 = ICR4 = ICR5 = kPwmTop;
  TCCR3A = _BV(COM3A1) | _BV(COM3B1) | _BV(COM3C1) | _BV(WGM31);
  TCCR3B = _BV(WGM33) | _BV(CS30);
  TCCR4A = _BV(COM4A1) | _BV(COM4B1) | _BV(COM4C1) | _BV(WGM41);
  TCCR4B = _BV(WGM43) | _BV(CS40);
  TCCR5A = _BV(COM5A1) | _BV(COM5B1) | _BV(COM5C1) | _BV(WGM51);
  TCCR5B = _BV(WGM53) | _BV(CS50);
  ICR1 = 39999;
  OCR1A = kServoMiddle;
  TCCR1A = _BV(COM1A1) | _BV(WGM11);
  TCCR1B = _BV(WGM13) | _BV(WGM12) | _BV(CS11);
  OCR2A = 249;
  TCCR2A = _BV(WGM21);
  TCCR2B = _BV(CS22);
  TIMSK2 = _BV(OCIE2A);
}

static void setUpPins() {
  DDRH = _BV(3) | _BV(4) | _BV(5);  // PWM 6, 7, 8
  DDRL = _BV(3) | _BV(4) | _BV(5);  // PWM 46, 45, 44
  DDRE |= _BV(3) | _BV(4) | _BV(5);  // PWM 5, 2, 3
  DDRA = 0xF0;                      // directions 26 to 29; 22 to 25 are the encoders' B
  PORTA = 0x0F;
  DDRC = _BV(5) | 0x1E;             // directions 32 and, of the steered axes, 36 to 33
  PORTC = _BV(7) | _BV(6);          // pull-ups of the switches 30 and 31
  DDRB |= _BV(5);                   // servo 11
  PORTD |= 0x0F;                    // pull-ups of the encoders' A
  EICRA = _BV(ISC00) | _BV(ISC10) | _BV(ISC20) | _BV(ISC30);  // both edges
  EIMSK = _BV(INT0) | _BV(INT1) | _BV(INT2) | _BV(INT3);
  ADMUX = _BV(REFS0);
  ADCSRA = _BV(ADEN) | _BV(ADSC) | _BV(ADIE) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0);
}

void setup() {
  cli();
  setUpPins();
  setUpTimers();
  setUpSerial();
  wdt_enable(WDTO_60MS);  // a program that hangs is restarted, and the motors stand meanwhile
  sei();
}

void loop() {
  static uint32_t last_ms = 0;
  uint32_t now_ms = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { now_ms = milliseconds; }
  while (!received.empty()) controller.receive(received.take(), now_ms);
  if (now_ms - last_ms < kPeriod_ms) return;
  const float period_s = 1e-3F * static_cast<float>(now_ms - last_ms);
  last_ms = now_ms;
  const ControllerInputs inputs = measure();
  outputs = controller.step(inputs, now_ms, period_s);
  act();
  send(inputs, now_ms);
  wdt_reset();
}
