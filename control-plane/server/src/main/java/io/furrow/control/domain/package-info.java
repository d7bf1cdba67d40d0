/** Manages domains: creation, change and deletion. */
package io.furrow.control.domain;
