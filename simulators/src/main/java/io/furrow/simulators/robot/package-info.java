/**
 * How a robot moves: rows through a field, the way along them, and what it does when told to stop, when something lies on its
 * way or when it meets another. Pure: nothing here reads a clock or a network.
 */
package io.furrow.simulators.robot;
