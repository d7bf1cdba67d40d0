/** A server assembled of Moquette's parts, in Moquette's package because they are package-private. */
package io.moquette.broker;
