/** What is known of the fields of a farm, as the topic {@code service.fields} carries it. */
package io.furrow.model.field;
