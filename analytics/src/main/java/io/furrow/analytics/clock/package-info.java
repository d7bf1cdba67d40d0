/**
 * The clocks of devices, as positions show them: which are so far behind that their positions come too late to count, and, where asked
 * for, by how much each is off, so that its positions count.
 */
package io.furrow.analytics.clock;
