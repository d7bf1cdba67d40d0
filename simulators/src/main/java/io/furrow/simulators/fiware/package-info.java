/**
 * A stand-in for FIWARE's IoT Agent JSON and its context broker Orion, for where no real one is given: the part of their
 * behaviour that Furrow meets, over real MQTT and HTTP, held against recorded notifications of Orion 4.7.
 *
 * <p>It works in memory, with a file to outlive a restart. It has no registrations, geo queries, aggregated types or
 * notification templates; what it does not know it refuses with 400 instead of ignoring it.
 */
package io.furrow.simulators.fiware;
