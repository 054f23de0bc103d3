#include "parts.h"
namespace strahl::attack {
int power(Attacker&, const Plan&) { return 0; }
}  // namespace strahl::attack
