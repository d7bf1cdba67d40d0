/**
 * A durable, bounded queue of byte records on disk: {@link io.furrow.connect.journal.Journal}. Independent of Connect
 * and of the content of the records.
 */
package io.furrow.connect.journal;
