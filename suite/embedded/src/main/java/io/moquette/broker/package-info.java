/** A server of Moquette's parts. In Moquette's package, because they are visible nowhere else. */
package io.moquette.broker;
