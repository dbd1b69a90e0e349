// The command line of Kinesphere.
#include "commands.hpp"

int main(int argc, char** argv) { return kinesphere::program::run_kinesphere(argc, argv); }
