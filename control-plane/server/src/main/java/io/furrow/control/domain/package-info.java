/** Manages domains: creation, change, and deletion when no mission runs in them. */
package io.furrow.control.domain;
