/** Who commanded what, when, and what came of it. */
package io.furrow.control.audit;
