/** Fields from the files of geographic information systems to {@code service.fields}. */
package io.furrow.control.field;
