#!/bin/sh
# The compilation pattern of docs/ci.md in Emacs.
. "$(dirname -- "$0")/lib.sh"
needs emacs

sed -n '/^```elisp$/,/^```$/p' "$source/docs/ci.md" | grep -v '^```' >pattern.el
[ -s pattern.el ] || fail "docs/ci.md has no pattern"
"$glint" check wrong.glint.yaml warned.glint.yaml --only W401 2>text.txt && fail "an error was expected"
cat >>pattern.el <<'S'
(setq compilation-error-regexp-alist '(glint))
(with-temp-buffer
  (insert-file-contents "text.txt")
  (compilation-mode)
  (compilation--ensure-parse (point-max))
  (goto-char (point-min))
  (let (message found)
    (while (not (eobp))
      (when (setq message (get-text-property (point) 'compilation-message))
        (let ((loc (compilation--message->loc message)))
          (push (format "%s|%d|%d|%d" (caar (compilation--loc->file-struct loc)) (compilation--loc->line loc)
                        (compilation--loc->col loc) (compilation--message->type message))
                found)))
      (forward-line 1))
    (with-temp-file "found.txt" (insert (mapconcat #'identity (nreverse found) "\n") "\n"))))
S
emacs --batch -Q -l pattern.el >emacs.txt 2>&1 || fail "$(cat emacs.txt)"
cat >wanted.txt <<'S'
wrong.glint.yaml|7|33|2
wrong.glint.yaml|8|46|2
warned.glint.yaml|5|32|1
open.obj|4|1|0
S
cmp found.txt wanted.txt || fail "$(cat found.txt)"
