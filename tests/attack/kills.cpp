#include "parts.h"
namespace strahl::attack {
int kills(Attacker&, const Plan&) { return 0; }
}  // namespace strahl::attack
