/** Times in entities. */
package io.furrow.model.time;
