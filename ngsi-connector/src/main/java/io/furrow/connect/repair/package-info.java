/** Finds out what the source was not told, and reads it from the context broker. Knows nothing of Connect. */
package io.furrow.connect.repair;
