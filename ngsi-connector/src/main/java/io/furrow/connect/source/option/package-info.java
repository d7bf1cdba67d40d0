/** Options of the source, one group per class. */
package io.furrow.connect.source.option;
