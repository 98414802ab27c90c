// What the Arduino IDE adds to a sketch.
void setup();
void loop();

int main() {
  setup();
  while (true) loop();
}
