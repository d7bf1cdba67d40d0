/**
 * A stand-in for FIWARE's IoT Agent JSON and its context broker Orion, for where no real one is given: the part of their
 * behaviour that Furrow meets, over real MQTT and HTTP, held against recorded notifications of Orion 4.7 and recorded exchanges
 * with Orion 4.7 and IoT Agent JSON 3.14.
 *
 * <p>It works in memory, with a file to outlive a restart. It has no registrations by clients, geo queries or notification templates;
 * what Orion has and it has not it refuses with 400.
 */
package io.furrow.simulators.fiware;
