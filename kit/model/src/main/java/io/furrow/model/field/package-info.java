/** What is known of the fields of a farm, as the topic {@code service.fields} carries it, and what a file of them contains. */
package io.furrow.model.field;
