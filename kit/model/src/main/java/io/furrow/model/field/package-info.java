/** The fields of a farm, as the topic {@code service.fields} contains them, and the content of field files. */
package io.furrow.model.field;
