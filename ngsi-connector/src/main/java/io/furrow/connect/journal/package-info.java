/**
 * A durable, bounded queue of byte records on disk: {@link io.furrow.connect.journal.Journal}. It knows nothing of Connect
 * or of what the bytes mean.
 */
package io.furrow.connect.journal;
