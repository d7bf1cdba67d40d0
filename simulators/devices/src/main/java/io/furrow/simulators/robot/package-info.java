/** Moves robots: rows through a field, the way along them, stops on command and meetings. Pure: nothing here reads a clock. */
package io.furrow.simulators.robot;
