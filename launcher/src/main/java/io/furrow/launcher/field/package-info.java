/** Fields, as {@code ./furrow fields} tells of them. */
package io.furrow.launcher.field;
