/** What the source has counted: {@link io.furrow.connect.ledger.Ledger}, and how it is shown. Knows no other part. */
package io.furrow.connect.ledger;
