/**
 * The counters of the source, {@link io.furrow.connect.ledger.Ledger}, and their pages. Independent of all other
 * packages.
 */
package io.furrow.connect.ledger;
