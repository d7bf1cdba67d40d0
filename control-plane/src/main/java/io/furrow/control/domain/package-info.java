/** Domains: made, changed, deleted when nothing runs in them. */
package io.furrow.control.domain;
